/* SPDX-License-Identifier: MIT */
/* The outcome that the best possible driver with this sensor reaches in a scenario. It follows from
 * the car and the sensor alone; no controller takes part.
 *
 * The best driver brakes fully from the first reading that shows a reason to. That brake acts after
 *     60 ms   the car ahead may come into sight just after a reading
 *     40 ms   the echo from 5 m is 29 ms on its way, and the PWM takes a new duty up to 10 ms later
 *     50 ms   dead time of the brake
 *    200 ms   lag of the brake, of first order
 * together L = BEST_DRIVER_LATE_S. After a delay of D and a lag of tau the speed has fallen by
 * A (t - D - tau (1 - exp(-(t - D) / tau))), which is never less than A (t - D - tau). So a car
 * that rolls on unbraked for L and then brakes with A at once is always behind the real one, and
 * the real car has a little more room than it (A tau^2 / 2 = 0.16 m at 8 m/s2). That is the whole
 * margin; no factor is added. For closing speed w, first seen at distance d:
 *     avoided            if w L + w^2 / 2A <= d (from 5 m at 8 m/s2: up to 6.57 m/s)
 *     else mitigated to  sqrt(w^2 - 2A (d - w L))
 * A car ahead that brakes at b gives no reason before the closing speed stands out of
 * the sensor's noise, which is 0.5 m/s: three standard deviations of a difference of readings with
 * 1 cm of noise each. That is 0.5 / b after it started, and the difference tells the speed of half
 * a period ago, 30 ms more. The gap gives a reason when it is 1 m, where the STOP pin is due. Where
 * a gap of 1 m or less is there from the start, full brake is owed with the first reading. */
#ifndef FUZZY51_BEST_DRIVER_H
#define FUZZY51_BEST_DRIVER_H

#define BEST_DRIVER_LATE_S (0.060 + 0.040 + 0.050 + 0.200)

/* Two cars on a lane. */
struct encounter {
    double own_mps, gap_m, lead_mps;
    double brake_mps2;       /* of the own car, at full brake */
    double lead_brakes_mps2; /* of the car ahead, from from_s on; 0: it does not brake */
    double from_s, to_mps;   /* it brakes until it drives at to_mps */
};

/* Speed of contact, m/s, of an own car whose brake acts fully from ACT_S seconds on; 0: no contact.
 * Exact: between two events both cars have a constant acceleration. */
double best_driver_contact_mps(const struct encounter *encounter, double act_s);

/* When a car that follows within the sensor's range gets a reason to brake, s. */
double best_driver_reason_s(const struct encounter *encounter);

#endif
