/* The names of functions in the object files: each begins with the model's, so that several models link into one program,
   and none is a name that another library has (C libraries have a `step`, too). */
#ifndef PREFIX_H
#define PREFIX_H

#ifndef MODEL_PREFIX
#include "model_prefix.h"
#endif

#define PREFIX_JOINED(prefix, name) prefix##name
#define PREFIX_OF(prefix, name) PREFIX_JOINED(prefix, name)
#define PREFIXED(name) PREFIX_OF(MODEL_PREFIX, name)

#define block_create PREFIXED(block_create)
#define block_free PREFIXED(block_free)
#define block_log_events PREFIXED(block_log_events)
#define block_refuse PREFIXED(block_refuse)
#define block_refuse_variable PREFIXED(block_refuse_variable)
#define block_enter_configuration PREFIXED(block_enter_configuration)
#define block_exit_configuration PREFIXED(block_exit_configuration)
#define block_set_times PREFIXED(block_set_times)
#define block_enter_initialization PREFIXED(block_enter_initialization)
#define block_exit_initialization PREFIXED(block_exit_initialization)
#define block_terminate PREFIXED(block_terminate)
#define block_reset PREFIXED(block_reset)
#define block_do_step PREFIXED(block_do_step)
#define block_time PREFIXED(block_time)
#define block_count PREFIXED(block_count)
#define block_is_unsigned PREFIXED(block_is_unsigned)
#define block_get_reals PREFIXED(block_get_reals)
#define block_get_integers PREFIXED(block_get_integers)
#define block_get_booleans PREFIXED(block_get_booleans)
#define block_get_unsigned PREFIXED(block_get_unsigned)
#define block_set_reals PREFIXED(block_set_reals)
#define block_set_integers PREFIXED(block_set_integers)
#define block_set_booleans PREFIXED(block_set_booleans)
#define block_set_unsigned PREFIXED(block_set_unsigned)
#define block_save PREFIXED(block_save)
#define block_restore PREFIXED(block_restore)
#define block_release PREFIXED(block_release)
#define block_serialized_size PREFIXED(block_serialized_size)
#define block_serialize PREFIXED(block_serialize)
#define block_deserialize PREFIXED(block_deserialize)
#define block_model PREFIXED(block_model)
#define block_digest PREFIXED(block_digest)
#define block_allowed PREFIXED(block_allowed)
#define block_phase_name PREFIXED(block_phase_name)
#define block_size_of PREFIXED(block_size_of)
#define block_new_rows PREFIXED(block_new_rows)
#define block_take PREFIXED(block_take)
#define block_evaluate_initial PREFIXED(block_evaluate_initial)
#define model_step PREFIXED(model_step)
#define model_initial PREFIXED(model_initial)
#define model_limits PREFIXED(model_limits)
#define model_constants PREFIXED(model_constants)
#define philox4x64 PREFIXED(philox4x64)
#define noise_normal PREFIXED(noise_normal)
#define noise_forget PREFIXED(noise_forget)
#define noise_at PREFIXED(noise_at)
#define noise_fill PREFIXED(noise_fill)

/* Between these two, functions are for this library alone: no other library in the process can put its own in place. */
#if defined(__ELF__) || defined(__MACH__)
#define PRIVATE_FROM_HERE _Pragma("GCC visibility push(hidden)")
#define PRIVATE_TO_HERE _Pragma("GCC visibility pop")
#else
#define PRIVATE_FROM_HERE
#define PRIVATE_TO_HERE
#endif

/* Where OLD_GLIBC is defined, a library loads from glibc 2.17 on, whatever it was linked against: of the functions whose
   error handling has changed since, it asks for the first version, which gives the same values. */
#ifdef OLD_GLIBC
#include <limits.h> /* defines __GLIBC__ where there is one */
#if defined(__GLIBC__) && defined(__x86_64__)
#define FIRST_VERSION(name) __asm__(".symver " #name "," #name "@GLIBC_2.2.5");
#elif defined(__GLIBC__) && defined(__aarch64__)
#define FIRST_VERSION(name) __asm__(".symver " #name "," #name "@GLIBC_2.17");
#else
#define FIRST_VERSION(name)
#endif
FIRST_VERSION(acos) FIRST_VERSION(acosh) FIRST_VERSION(asin) FIRST_VERSION(atan2) FIRST_VERSION(atanh) FIRST_VERSION(cosh)
FIRST_VERSION(exp) FIRST_VERSION(exp2) FIRST_VERSION(fmod) FIRST_VERSION(hypot) FIRST_VERSION(log) FIRST_VERSION(log10)
FIRST_VERSION(log2) FIRST_VERSION(pow) FIRST_VERSION(remainder) FIRST_VERSION(sinh) FIRST_VERSION(sqrt)
#endif

/* A product and a sum are rounded one after the other, whatever the compiler's options: where a processor can do both
   with one rounding, it would not give the bits of the reference. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif

#endif
