/* The kernel center_of_mass of tm5_700. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* Centre of mass (m) of all that moves, in the base frame (with a floating base: in the world, and the base's own mass counts). From cga_codegen.kernels.tree_kinematics.center_of_mass.
   62 mul, 37 add, 0 div, 0 sqrt. */
static inline void cga_tm5_700_tree_center_of_mass_body(const T *restrict c, const T *restrict s, T *restrict out)
{
    const T t0 = s[1] * c[0];
    const T t1 = K(0.7478170000000001) * t0;
    const T t2 = t0 * K(0.329);
    const T t3 = t0 * c[2];
    const T t4 = c[0] * c[1];
    const T t5 = s[2] * t4;
    const T t6 = t3 + t5;
    const T t7 = K(0.3115) * t6;
    const T t8 = K(0.1223) * s[0];
    const T t9 = t7 + t8;
    const T t10 = t2 + t9;
    const T t11 = K(1.576) * t10;
    const T t12 = t6 * c[3];
    const T t13 = c[2] * t4;
    const T t14 = t0 * s[2];
    const T t15 = t13 - t14;
    const T t16 = s[3] * t15;
    const T t17 = t12 + t16;
    const T t18 = K(0.106) * t17;
    const T t19 = t10 + t18;
    const T t20 = K(1.576) * t19;
    const T t21 = s[0] * c[4];
    const T t22 = c[3] * t15;
    const T t23 = t6 * s[3];
    const T t24 = t22 - t23;
    const T t25 = s[4] * t24;
    const T t26 = t21 + t25;
    const T t27 = K(0.11315) * t26;
    const T t28 = t19 + t27;
    const T t29 = K(0.65) * t28;
    const T t30 = t20 + t29;
    const T t31 = t11 + t30;
    const T t32 = t1 + t31;
    const T t33 = K(0.0535503909178537) * t32;
    const T t34 = s[1] * s[0];
    const T t35 = K(0.7478170000000001) * t34;
    const T t36 = K(0.329) * t34;
    const T t37 = c[2] * t34;
    const T t38 = c[1] * s[0];
    const T t39 = s[2] * t38;
    const T t40 = t37 + t39;
    const T t41 = K(0.3115) * t40;
    const T t42 = c[0] * K(0.1223);
    const T t43 = t41 - t42;
    const T t44 = t36 + t43;
    const T t45 = K(1.576) * t44;
    const T t46 = c[3] * t40;
    const T t47 = c[2] * t38;
    const T t48 = s[2] * t34;
    const T t49 = t47 - t48;
    const T t50 = s[3] * t49;
    const T t51 = t46 + t50;
    const T t52 = K(0.106) * t51;
    const T t53 = t44 + t52;
    const T t54 = K(1.576) * t53;
    const T t55 = c[0] * c[4];
    const T t56 = c[3] * t49;
    const T t57 = s[3] * t40;
    const T t58 = t56 - t57;
    const T t59 = s[4] * t58;
    const T t60 = t55 - t59;
    const T t61 = K(0.11315) * t60;
    const T t62 = t53 - t61;
    const T t63 = K(0.65) * t62;
    const T t64 = t54 + t63;
    const T t65 = t45 + t64;
    const T t66 = t35 + t65;
    const T t67 = K(0.0535503909178537) * t66;
    const T t68 = K(0.329) * c[1];
    const T t69 = K(0.1452) + t68;
    const T t70 = K(2.273) * t69;
    const T t71 = c[2] * c[1];
    const T t72 = s[1] * s[2];
    const T t73 = t71 - t72;
    const T t74 = K(0.3115) * t73;
    const T t75 = t69 + t74;
    const T t76 = K(1.576) * t75;
    const T t77 = s[1] * c[2];
    const T t78 = s[2] * c[1];
    const T t79 = t77 + t78;
    const T t80 = s[3] * t79;
    const T t81 = c[3] * t73;
    const T t82 = t80 - t81;
    const T t83 = K(0.106) * t82;
    const T t84 = t75 - t83;
    const T t85 = K(1.576) * t84;
    const T t86 = c[3] * t79;
    const T t87 = s[3] * t73;
    const T t88 = t86 + t87;
    const T t89 = s[4] * t88;
    const T t90 = K(0.11315) * t89;
    const T t91 = t84 - t90;
    const T t92 = K(0.65) * t91;
    const T t93 = t85 + t92;
    const T t94 = t76 + t93;
    const T t95 = t70 + t94;
    const T t96 = K(1.2439284) + t95;
    const T t97 = K(0.5854464) + t96;
    const T t98 = K(0.0535503909178537) * t97;
    out[0] = t33;
    out[1] = t67;
    out[2] = t98;
}

CGA_EXPORT int cga_tm5_700_tree_center_of_mass(const double *restrict q /* 6 */, double *restrict out /* 3 */)
{
    double c[6], s[6];
    for (int j = 0; j < 6; ++j) { c[j] = cos(q[j]); s[j] = sin(q[j]); }
    cga_tm5_700_tree_center_of_mass_body(c, s, out);
    return cga_not_finite(q, 6);
}

CGA_EXPORT int cga_tm5_700_tree_center_of_mass_batch(int64_t n, const double *restrict q /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_tm5_700_tree_center_of_mass(q + k * 6, out + k * 3);
    return bad;
}
