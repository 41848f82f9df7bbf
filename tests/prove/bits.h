/* SPDX-License-Identifier: MIT */
/* What the provers do not know of C's shifts, masks and casts, as arithmetic. WP takes these lines
 * as true; tried.c checks each of them on all its values. */
#ifndef FUZZY51_PROVE_BITS_H
#define FUZZY51_PROVE_BITS_H

#include <stdint.h>

/*@ axiomatic Bits {
      axiom byte: \forall integer x; 0 <= x ==> (uint8_t)x == x % 256;
      axiom negative_word: \forall integer x; -65536 <= x < 0 ==> (uint16_t)x == x + 65536;
      axiom word: \forall integer x; 0 <= x ==> (uint16_t)x == x % 65536;
      axiom mask_15: \forall integer x; 0 <= x ==> (x & 15) == x % 16;
      axiom mask_255: \forall integer x; 0 <= x ==> (x & 255) == x % 256;

      axiom right_1: \forall integer x; 0 <= x ==> (x >> 1) == x / 2;
      axiom right_2: \forall integer x; 0 <= x ==> (x >> 2) == x / 4;
      axiom right_3: \forall integer x; 0 <= x ==> (x >> 3) == x / 8;
      axiom right_4: \forall integer x; 0 <= x ==> (x >> 4) == x / 16;
      axiom right_5: \forall integer x; 0 <= x ==> (x >> 5) == x / 32;
      axiom right_6: \forall integer x; 0 <= x ==> (x >> 6) == x / 64;
      axiom right_7: \forall integer x; 0 <= x ==> (x >> 7) == x / 128;
      axiom right_8: \forall integer x; 0 <= x ==> (x >> 8) == x / 256;
      axiom right_9: \forall integer x; 0 <= x ==> (x >> 9) == x / 512;
      axiom right_10: \forall integer x; 0 <= x ==> (x >> 10) == x / 1024;
      axiom right_16: \forall integer x; 0 <= x ==> (x >> 16) == x / 65536;

      axiom left_1: \forall integer x; 0 <= x ==> (x << 1) == x * 2;
      axiom left_2: \forall integer x; 0 <= x ==> (x << 2) == x * 4;
      axiom left_3: \forall integer x; 0 <= x ==> (x << 3) == x * 8;
      axiom left_4: \forall integer x; 0 <= x ==> (x << 4) == x * 16;
      axiom left_5: \forall integer x; 0 <= x ==> (x << 5) == x * 32;
      axiom left_8: \forall integer x; 0 <= x ==> (x << 8) == x * 256;
      axiom left_16: \forall integer x; 0 <= x ==> (x << 16) == x * 65536;

      axiom or_byte: \forall integer x, y;
          0 <= x && x % 256 == 0 && 0 <= y < 256 ==> (x | y) == x + y && (y | x) == x + y;
      axiom or_word: \forall integer x, y;
          0 <= x && x % 65536 == 0 && 0 <= y < 65536 ==> (x | y) == x + y && (y | x) == x + y;
    } */

/* Only for the units that ask for it: it leads the provers astray where no number is negative. */
#ifdef BITS_NEGATIVE
/*@ axiomatic BitsNegative {
      axiom right_1_negative: \forall integer x; x < 0 ==> (x >> 1) == (x - 1) / 2;
    } */
#endif

#endif
