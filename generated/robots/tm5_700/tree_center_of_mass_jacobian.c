/* The kernel center_of_mass_jacobian of tm5_700. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* Jacobian (3 x n) of the centre of mass: what a joint carries moves with it, column (w x h + m v) / total mass. From cga_codegen.kernels.tree_kinematics.center_of_mass_jacobian.
   100 mul, 52 add, 0 div, 0 sqrt. */
static inline void cga_tm5_700_tree_center_of_mass_jacobian_body(const T *restrict c, const T *restrict s, T *restrict out)
{
    const T t0 = s[1] * s[0];
    const T t1 = K(0.7478170000000001) * t0;
    const T t2 = t0 * K(0.329);
    const T t3 = t0 * c[2];
    const T t4 = s[0] * c[1];
    const T t5 = s[2] * t4;
    const T t6 = t3 + t5;
    const T t7 = K(0.3115) * t6;
    const T t8 = K(0.1223) * c[0];
    const T t9 = t7 - t8;
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
    const T t21 = c[0] * c[4];
    const T t22 = c[3] * t15;
    const T t23 = t6 * s[3];
    const T t24 = t22 - t23;
    const T t25 = s[4] * t24;
    const T t26 = t21 - t25;
    const T t27 = K(0.11315) * t26;
    const T t28 = t19 - t27;
    const T t29 = K(0.65) * t28;
    const T t30 = t20 + t29;
    const T t31 = t11 + t30;
    const T t32 = t1 + t31;
    const T t33 = K(0.0535503909178537) * t32;
    const T t34 = K(0.329) * c[1];
    const T t35 = K(0.1452) + t34;
    const T t36 = K(2.273) * t35;
    const T t37 = c[2] * c[1];
    const T t38 = s[1] * s[2];
    const T t39 = t37 - t38;
    const T t40 = K(0.3115) * t39;
    const T t41 = t35 + t40;
    const T t42 = K(1.576) * t41;
    const T t43 = s[1] * c[2];
    const T t44 = s[2] * c[1];
    const T t45 = t43 + t44;
    const T t46 = s[3] * t45;
    const T t47 = c[3] * t39;
    const T t48 = t46 - t47;
    const T t49 = K(0.106) * t48;
    const T t50 = t41 - t49;
    const T t51 = K(1.576) * t50;
    const T t52 = c[3] * t45;
    const T t53 = s[3] * t39;
    const T t54 = t52 + t53;
    const T t55 = s[4] * t54;
    const T t56 = K(0.11315) * t55;
    const T t57 = t50 - t56;
    const T t58 = K(0.65) * t57;
    const T t59 = t51 + t58;
    const T t60 = t42 + t59;
    const T t61 = t36 + t60;
    const T t62 = K(1.2439284) + t61;
    const T t63 = t62 - K(2.1260184);
    const T t64 = c[0] * t63;
    const T t65 = K(0.0535503909178537) * t64;
    const T t66 = t35 * K(6.075);
    const T t67 = t61 - t66;
    const T t68 = c[0] * t67;
    const T t69 = K(0.0535503909178537) * t68;
    const T t70 = t41 * K(3.802);
    const T t71 = t60 - t70;
    const T t72 = c[0] * t71;
    const T t73 = K(0.0535503909178537) * t72;
    const T t74 = t50 * K(2.226);
    const T t75 = t59 - t74;
    const T t76 = t17 * t75;
    const T t77 = t19 * K(2.226);
    const T t78 = t30 - t77;
    const T t79 = t48 * t78;
    const T t80 = t76 + t79;
    const T t81 = K(0.0535503909178537) * t80;
    const T t82 = s[1] * c[0];
    const T t83 = K(0.7478170000000001) * t82;
    const T t84 = K(0.329) * t82;
    const T t85 = c[2] * t82;
    const T t86 = c[1] * c[0];
    const T t87 = s[2] * t86;
    const T t88 = t85 + t87;
    const T t89 = K(0.3115) * t88;
    const T t90 = s[0] * K(0.1223);
    const T t91 = t89 + t90;
    const T t92 = t84 + t91;
    const T t93 = K(1.576) * t92;
    const T t94 = c[3] * t88;
    const T t95 = c[2] * t86;
    const T t96 = s[2] * t82;
    const T t97 = t95 - t96;
    const T t98 = s[3] * t97;
    const T t99 = t94 + t98;
    const T t100 = K(0.106) * t99;
    const T t101 = t92 + t100;
    const T t102 = K(1.576) * t101;
    const T t103 = s[0] * c[4];
    const T t104 = c[3] * t97;
    const T t105 = s[3] * t88;
    const T t106 = t104 - t105;
    const T t107 = s[4] * t106;
    const T t108 = t103 + t107;
    const T t109 = K(0.11315) * t108;
    const T t110 = t101 + t109;
    const T t111 = K(0.65) * t110;
    const T t112 = t102 + t111;
    const T t113 = t93 + t112;
    const T t114 = t83 + t113;
    const T t115 = K(0.0535503909178537) * t114;
    const T t116 = s[0] * t63;
    const T t117 = K(0.0535503909178537) * t116;
    const T t118 = s[0] * t67;
    const T t119 = K(0.0535503909178537) * t118;
    const T t120 = s[0] * t71;
    const T t121 = K(0.0535503909178537) * t120;
    const T t122 = K(2.226) * t101;
    const T t123 = t112 - t122;
    const T t124 = t48 * t123;
    const T t125 = t75 * t99;
    const T t126 = t124 + t125;
    const T t127 = K(0.0535503909178537) * t126;
    const T t128 = s[0] * t32;
    const T t129 = c[0] * t114;
    const T t130 = t128 + t129;
    const T t131 = K(0.0535503909178537) * t130;
    const T t132 = t0 * K(1.9986750000000002);
    const T t133 = t32 - t132;
    const T t134 = s[0] * t133;
    const T t135 = t82 * K(1.9986750000000002);
    const T t136 = t114 - t135;
    const T t137 = c[0] * t136;
    const T t138 = t134 + t137;
    const T t139 = K(0.0535503909178537) * t138;
    const T t140 = t10 * K(3.802);
    const T t141 = t31 - t140;
    const T t142 = s[0] * t141;
    const T t143 = K(3.802) * t92;
    const T t144 = t113 - t143;
    const T t145 = c[0] * t144;
    const T t146 = t142 + t145;
    const T t147 = K(0.0535503909178537) * t146;
    const T t148 = t78 * t99;
    const T t149 = t17 * t123;
    const T t150 = t148 - t149;
    const T t151 = K(0.0535503909178537) * t150;
    out[0] = -t33;
    out[1] = t65;
    out[2] = t69;
    out[3] = t73;
    out[4] = t81;
    out[5] = K(0.0);
    out[6] = t115;
    out[7] = t117;
    out[8] = t119;
    out[9] = t121;
    out[10] = -t127;
    out[11] = K(0.0);
    out[12] = K(0.0);
    out[13] = -t131;
    out[14] = -t139;
    out[15] = -t147;
    out[16] = t151;
    out[17] = K(0.0);
}

CGA_EXPORT int cga_tm5_700_tree_center_of_mass_jacobian(const double *restrict q /* 6 */, double *restrict out /* 18 */)
{
    double c[6], s[6];
    for (int j = 0; j < 6; ++j) { c[j] = cos(q[j]); s[j] = sin(q[j]); }
    cga_tm5_700_tree_center_of_mass_jacobian_body(c, s, out);
    return cga_not_finite(q, 6);
}

CGA_EXPORT int cga_tm5_700_tree_center_of_mass_jacobian_batch(int64_t n, const double *restrict q /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_tm5_700_tree_center_of_mass_jacobian(q + k * 6, out + k * 18);
    return bad;
}
