/* @{banner}

   Kinematics@{and_dynamics} of @{robot} in plain C99, without allocation and without state: every function may be called by many threads.
   Each returns 0, or 1 if an input holds NaN or infinity (the result is then not to be used). Arrays do not overlap. Matrices are row-major.
   Units are SI and radians. <function>_batch does the same for n configurations, one behind the other in every array.
   Motors: 1 e12 e13 e23 e1i e2i e3i e123i; x' = M x ~M; translators are 1 - t ei / 2. Twists are linear first: (v, w).
   Frames LOCAL, WORLD and LOCAL_WORLD_ALIGNED mean what they mean in Pinocchio.
@{arrays} */

#ifndef CGA_@{macro}_H
#define CGA_@{macro}_H

#include <stdint.h>

#ifdef _WIN32
#define CGA_EXPORT __declspec(dllexport)
#else
#define CGA_EXPORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

@{functions}
#ifdef __cplusplus
}
#endif

#endif
