(* SPDX-License-Identifier: MIT *)
(* SDCC's mcs51 for Frama-C, which knows no such machine: `-load-module` it, then `-machdep mcs51`. Its int of 16
   bits, long of 32 and little end are those of x86_16. sizes.c holds what the proofs take from here against what
   SDCC says itself. A pointer has 2 bytes, as one to __code or __xdata has; the firmware has no pointer without
   the name of a memory, which would have 3. *)
let () =
  File.new_machdep "mcs51"
    { Machdeps.x86_16 with
      Cil_types.version = "SDCC for the 8051";
      char_is_unsigned = true;
      sizeof_ptr = 2;
      sizeof_double = 4;
      sizeof_longdouble = 4;
      alignof_short = 1;
      alignof_int = 1;
      alignof_long = 1;
      alignof_longlong = 1;
      alignof_ptr = 1;
      alignof_float = 1;
      alignof_double = 1;
      alignof_longdouble = 1;
      alignof_str = 1;
      alignof_fun = 1;
      alignof_aligned = 1 }
