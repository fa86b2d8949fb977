/* The kernel gravity of tm5_700. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

#include <math.h>
#include <stdint.h>

#ifdef _WIN32
#define CGA_EXPORT __declspec(dllexport)
#else
#define CGA_EXPORT
#endif

/* 0 * x is zero for every finite x, and NaN for NaN and infinity. */
static inline int cga_not_finite(const double *x, int n)
{
    double zero = 0.0;
    for (int i = 0; i < n; ++i)
        zero += 0.0 * x[i];
    return zero != 0.0;
}

#if defined(__GNUC__)
#define CGA_NOINLINE __attribute__((noinline))
#else
#define CGA_NOINLINE
#endif

/* T is the number type of the bodies, K(x) a constant of that type, ROOT(x) a square root. */
#ifndef T
#define T double
#define K(x) (x)
#define ROOT(x) sqrt(x)
#endif

/* g(q): inverse dynamics at rest. From cga_codegen.kernels.dynamics.gravity.
   61 mul, 33 add, 0 div, 0 sqrt. */
static inline void cga_tm5_700_tree_gravity_body(const T *restrict c, const T *restrict s, T *restrict out)
{
    const T t0 = K(9.81) * s[1];
    const T t1 = c[2] * t0;
    const T t2 = c[1] * K(9.81);
    const T t3 = s[2] * t2;
    const T t4 = t1 + t3;
    const T t5 = c[3] * t4;
    const T t6 = c[2] * t2;
    const T t7 = t0 * s[2];
    const T t8 = t6 - t7;
    const T t9 = s[3] * t8;
    const T t10 = t5 + t9;
    const T t11 = K(1.576) * t10;
    const T t12 = t10 * c[4];
    const T t13 = K(1.576) * t12;
    const T t14 = t12 * c[5];
    const T t15 = t4 * s[3];
    const T t16 = c[3] * t8;
    const T t17 = t15 - t16;
    const T t18 = s[5] * t17;
    const T t19 = t14 + t18;
    const T t20 = K(0.65) * t19;
    const T t21 = c[5] * t20;
    const T t22 = t12 * s[5];
    const T t23 = c[5] * t17;
    const T t24 = t22 - t23;
    const T t25 = K(0.65) * t24;
    const T t26 = s[5] * t25;
    const T t27 = t21 + t26;
    const T t28 = t13 + t27;
    const T t29 = c[4] * t28;
    const T t30 = t10 * s[4];
    const T t31 = K(1.576) * t30;
    const T t32 = K(0.65) * t30;
    const T t33 = t31 + t32;
    const T t34 = s[4] * t33;
    const T t35 = t29 + t34;
    const T t36 = t11 + t35;
    const T t37 = c[3] * t36;
    const T t38 = K(1.576) * t17;
    const T t39 = c[5] * t25;
    const T t40 = s[5] * t20;
    const T t41 = t39 - t40;
    const T t42 = t38 - t41;
    const T t43 = t38 + t42;
    const T t44 = s[3] * t43;
    const T t45 = t37 + t44;
    const T t46 = K(0.1223) * t45;
    const T t47 = t41 * K(0.11315);
    const T t48 = c[4] * t47;
    const T t49 = c[4] * t33;
    const T t50 = t28 * s[4];
    const T t51 = t49 - t50;
    const T t52 = K(0.106) * t51;
    const T t53 = t48 + t52;
    const T t54 = s[3] * t53;
    const T t55 = t27 * K(0.11315);
    const T t56 = c[3] * t55;
    const T t57 = t54 - t56;
    const T t58 = t46 - t57;
    const T t59 = c[2] * t58;
    const T t60 = c[3] * t53;
    const T t61 = s[3] * t55;
    const T t62 = t60 + t61;
    const T t63 = c[3] * t43;
    const T t64 = s[3] * t36;
    const T t65 = t63 - t64;
    const T t66 = K(0.1223) * t65;
    const T t67 = t51 * K(0.3115);
    const T t68 = t66 - t67;
    const T t69 = t62 - t68;
    const T t70 = s[2] * t69;
    const T t71 = t59 - t70;
    const T t72 = c[1] * t71;
    const T t73 = s[2] * t58;
    const T t74 = c[2] * t69;
    const T t75 = t73 + t74;
    const T t76 = t51 * K(0.329);
    const T t77 = t75 + t76;
    const T t78 = s[1] * t77;
    const T t79 = t72 - t78;
    const T t80 = s[4] * t47;
    const T t81 = t35 * K(0.106);
    const T t82 = t80 + t81;
    const T t83 = t45 * K(0.3115);
    const T t84 = t82 + t83;
    const T t85 = t8 * K(2.273);
    const T t86 = t65 - t85;
    const T t87 = s[2] * t86;
    const T t88 = t4 * K(2.273);
    const T t89 = t45 + t88;
    const T t90 = c[2] * t89;
    const T t91 = t87 + t90;
    const T t92 = K(0.329) * t91;
    const T t93 = t84 + t92;
    out[0] = -t79;
    out[1] = -t93;
    out[2] = -t84;
    out[3] = -t82;
    out[4] = -t55;
    out[5] = K(0.0);
}

CGA_EXPORT int cga_tm5_700_tree_gravity(const double *restrict q /* 6 */, double *restrict out /* 6 */)
{
    double c[6], s[6];
    for (int j = 0; j < 6; ++j) { c[j] = cos(q[j]); s[j] = sin(q[j]); }
    cga_tm5_700_tree_gravity_body(c, s, out);
    return cga_not_finite(q, 6);
}

CGA_EXPORT int cga_tm5_700_tree_gravity_batch(int64_t n, const double *restrict q /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_tm5_700_tree_gravity(q + k * 6, out + k * 6);
    return bad;
}
