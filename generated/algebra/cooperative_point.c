/* The cooperative point from its points. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* The primitive X = P1 ^ ... ^ Pk, of line and plane ^ ei, P = e0 + x + x^2/2 ei: its size is the weight (paper A, eq. 14). From cga_codegen.kernels.primitives.primitive.
   4 mul, 2 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_primitive_body(const T *restrict points, T *restrict out)
{
    const T t0 = points[0] * points[0];
    const T t1 = points[1] * points[1];
    const T t2 = t0 + t1;
    const T t3 = points[2] * points[2];
    const T t4 = t2 + t3;
    const T t5 = K(0.5) * t4;
    out[0] = K(1.0);
    out[1] = points[0];
    out[2] = points[1];
    out[3] = points[2];
    out[4] = t5;
}

CGA_EXPORT int cga_cooperative_point_primitive(const double *restrict points /* 3 */, double *restrict out /* 5 */)
{
    cga_cooperative_point_primitive_body(points, out);
    return cga_not_finite(points, 3);
}

CGA_EXPORT int cga_cooperative_point_primitive_batch(int64_t n, const double *restrict points /* 3 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_primitive(points + k * 3, out + k * 5);
    return bad;
}

/* Derivative of the primitive by the points: one factor after the other is replaced by its derivative (paper A, eqs. 15-17). From cga_codegen.kernels.primitives.primitive_jacobian.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_primitive_jacobian_body(const T *restrict points, T *restrict out)
{
    out[0] = K(0.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(1.0);
    out[4] = K(0.0);
    out[5] = K(0.0);
    out[6] = K(0.0);
    out[7] = K(1.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(1.0);
    out[12] = points[0];
    out[13] = points[1];
    out[14] = points[2];
}

CGA_EXPORT int cga_cooperative_point_primitive_jacobian(const double *restrict points /* 3 */, double *restrict out /* 15 */)
{
    cga_cooperative_point_primitive_jacobian_body(points, out);
    return cga_not_finite(points, 3);
}

CGA_EXPORT int cga_cooperative_point_primitive_jacobian_batch(int64_t n, const double *restrict points /* 3 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_primitive_jacobian(points + k * 3, out + k * 15);
    return bad;
}

/* V with V X_u ~V = X over its weight (paper A, eq. 28). From cga_codegen.kernels.similarity.similarity.
   3 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_similarity_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    const T t0 = K(0.5) * points[0];
    const T t1 = K(0.5) * points[1];
    const T t2 = K(0.5) * points[2];
    out[0] = K(1.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(0.0);
    out[4] = K(0.0);
    out[5] = -t0;
    out[6] = -t1;
    out[7] = K(0.0);
    out[8] = -t2;
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    (void)chart;
}

CGA_EXPORT int cga_cooperative_point_similarity(const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out /* 12 */)
{
    cga_cooperative_point_similarity_body(points, chart, out);
    return cga_not_finite(points, 3) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_similarity_batch(int64_t n, const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_similarity(points + k * 3, chart + k * 1, out + k * 12);
    return bad;
}

/* The factors of V: rotor 1 e12 e13 e23, centre (m), radius (m; 1 of flat ones). From cga_codegen.kernels.similarity.parts.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_parts_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    out[0] = K(1.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(0.0);
    out[4] = points[0];
    out[5] = points[1];
    out[6] = points[2];
    out[7] = K(1.0);
    (void)chart;
}

CGA_EXPORT int cga_cooperative_point_parts(const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out /* 8 */)
{
    cga_cooperative_point_parts_body(points, chart, out);
    return cga_not_finite(points, 3) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_parts_batch(int64_t n, const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_parts(points + k * 3, chart + k * 1, out + k * 8);
    return bad;
}

/* dV = -1/2 V J_G by the points (paper A, eq. 29). From cga_codegen.kernels.similarity.analytic_jacobian.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_analytic_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    out[0] = K(0.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(0.0);
    out[4] = K(0.0);
    out[5] = K(0.0);
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = K(0.0);
    out[13] = K(0.0);
    out[14] = K(0.0);
    out[15] = -K(0.5);
    out[16] = K(0.0);
    out[17] = K(0.0);
    out[18] = K(0.0);
    out[19] = -K(0.5);
    out[20] = K(0.0);
    out[21] = K(0.0);
    out[22] = K(0.0);
    out[23] = K(0.0);
    out[24] = K(0.0);
    out[25] = K(0.0);
    out[26] = -K(0.5);
    out[27] = K(0.0);
    out[28] = K(0.0);
    out[29] = K(0.0);
    out[30] = K(0.0);
    out[31] = K(0.0);
    out[32] = K(0.0);
    out[33] = K(0.0);
    out[34] = K(0.0);
    out[35] = K(0.0);
    (void)points;
    (void)chart;
}

CGA_EXPORT int cga_cooperative_point_analytic_jacobian(const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out /* 36 */)
{
    cga_cooperative_point_analytic_jacobian_body(points, chart, out);
    return cga_not_finite(points, 3) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_analytic_jacobian_batch(int64_t n, const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_analytic_jacobian(points + k * 3, chart + k * 1, out + k * 36);
    return bad;
}

/* J_G = -2 ~V dV by the points, rows e12 e13 e23 e0i e1i e2i e3i, in the primitive's own frame (paper A, eq. 30). From cga_codegen.kernels.similarity.geometric_jacobian.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_geometric_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    out[0] = K(0.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(0.0);
    out[4] = K(0.0);
    out[5] = K(0.0);
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = K(1.0);
    out[13] = K(0.0);
    out[14] = K(0.0);
    out[15] = K(0.0);
    out[16] = K(1.0);
    out[17] = K(0.0);
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(1.0);
    (void)points;
    (void)chart;
}

CGA_EXPORT int cga_cooperative_point_geometric_jacobian(const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out /* 21 */)
{
    cga_cooperative_point_geometric_jacobian_body(points, chart, out);
    return cga_not_finite(points, 3) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_geometric_jacobian_batch(int64_t n, const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_geometric_jacobian(points + k * 3, chart + k * 1, out + k * 21);
    return bad;
}

/* The geometric Jacobian without the motions that leave the primitive where it is: rows of the controllable blades, others zero. From cga_codegen.kernels.similarity.horizontal_jacobian.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_horizontal_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    out[0] = K(0.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(0.0);
    out[4] = K(0.0);
    out[5] = K(0.0);
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = K(1.0);
    out[13] = K(0.0);
    out[14] = K(0.0);
    out[15] = K(0.0);
    out[16] = K(1.0);
    out[17] = K(0.0);
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(1.0);
    (void)points;
    (void)chart;
}

CGA_EXPORT int cga_cooperative_point_horizontal_jacobian(const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out /* 21 */)
{
    cga_cooperative_point_horizontal_jacobian_body(points, chart, out);
    return cga_not_finite(points, 3) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_horizontal_jacobian_batch(int64_t n, const double *restrict points /* 3 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_horizontal_jacobian(points + k * 3, chart + k * 1, out + k * 21);
    return bad;
}

/* Time derivative of `geometric_jacobian` where the points move with `velocities` (m/s). From cga_codegen.kernels.similarity.geometric_jacobian_derivative.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_geometric_jacobian_derivative_body(const T *restrict points, const T *restrict chart, const T *restrict velocities, T *restrict out)
{
    out[0] = K(0.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(0.0);
    out[4] = K(0.0);
    out[5] = K(0.0);
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = K(0.0);
    out[13] = K(0.0);
    out[14] = K(0.0);
    out[15] = K(0.0);
    out[16] = K(0.0);
    out[17] = K(0.0);
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(0.0);
    (void)points;
    (void)chart;
    (void)velocities;
}

CGA_EXPORT int cga_cooperative_point_geometric_jacobian_derivative(const double *restrict points /* 3 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 3 */, double *restrict out /* 21 */)
{
    cga_cooperative_point_geometric_jacobian_derivative_body(points, chart, velocities, out);
    return cga_not_finite(points, 3) || cga_not_finite(chart, 1) || cga_not_finite(velocities, 3);
}

CGA_EXPORT int cga_cooperative_point_geometric_jacobian_derivative_batch(int64_t n, const double *restrict points /* 3 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 3 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_geometric_jacobian_derivative(points + k * 3, chart + k * 1, velocities + k * 3, out + k * 21);
    return bad;
}

/* Time derivative of `horizontal_jacobian` where the points move with `velocities` (m/s). From cga_codegen.kernels.similarity.horizontal_jacobian_derivative.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_horizontal_jacobian_derivative_body(const T *restrict points, const T *restrict chart, const T *restrict velocities, T *restrict out)
{
    out[0] = K(0.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(0.0);
    out[4] = K(0.0);
    out[5] = K(0.0);
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = K(0.0);
    out[13] = K(0.0);
    out[14] = K(0.0);
    out[15] = K(0.0);
    out[16] = K(0.0);
    out[17] = K(0.0);
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(0.0);
    (void)points;
    (void)chart;
    (void)velocities;
}

CGA_EXPORT int cga_cooperative_point_horizontal_jacobian_derivative(const double *restrict points /* 3 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 3 */, double *restrict out /* 21 */)
{
    cga_cooperative_point_horizontal_jacobian_derivative_body(points, chart, velocities, out);
    return cga_not_finite(points, 3) || cga_not_finite(chart, 1) || cga_not_finite(velocities, 3);
}

CGA_EXPORT int cga_cooperative_point_horizontal_jacobian_derivative_batch(int64_t n, const double *restrict points /* 3 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 3 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_horizontal_jacobian_derivative(points + k * 3, chart + k * 1, velocities + k * 3, out + k * 21);
    return bad;
}

/* How far a primitive is from degenerate: |a| (m) of two points, the sine |a x b|/(|a||b|) of three, |det[a, b, d]|/(|a||b||d|) of From cga_codegen.kernels.primitives.degeneracy.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_degeneracy_body(const T *restrict points, T *restrict out)
{
    out[0] = K(1.0);
    (void)points;
}

CGA_EXPORT int cga_cooperative_point_degeneracy(const double *restrict points /* 3 */, double *restrict out /* 1 */)
{
    cga_cooperative_point_degeneracy_body(points, out);
    return cga_not_finite(points, 3);
}

CGA_EXPORT int cga_cooperative_point_degeneracy_batch(int64_t n, const double *restrict points /* 3 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_degeneracy(points + k * 3, out + k * 1);
    return bad;
}

/* What is looked at before the rest is trusted. Total. From cga_codegen.kernels.primitives.guard.
   3 mul, 2 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_guard_body(const T *restrict points, T *restrict out)
{
    const T t0 = points[0] * points[0];
    const T t1 = points[1] * points[1];
    const T t2 = t0 + t1;
    const T t3 = points[2] * points[2];
    const T t4 = t2 + t3;
    out[0] = K(1.0);
    out[1] = K(0.0);
    out[2] = K(1.0);
    out[3] = t4;
}

CGA_EXPORT int cga_cooperative_point_guard(const double *restrict points /* 3 */, double *restrict out /* 4 */)
{
    cga_cooperative_point_guard_body(points, out);
    return cga_not_finite(points, 3);
}

CGA_EXPORT int cga_cooperative_point_guard_batch(int64_t n, const double *restrict points /* 3 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_guard(points + k * 3, out + k * 4);
    return bad;
}

/* Derivative of `degeneracy` by the points. From cga_codegen.kernels.primitives.degeneracy_gradient.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_degeneracy_gradient_body(const T *restrict points, T *restrict out)
{
    out[0] = K(0.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    (void)points;
}

CGA_EXPORT int cga_cooperative_point_degeneracy_gradient(const double *restrict points /* 3 */, double *restrict out /* 3 */)
{
    cga_cooperative_point_degeneracy_gradient_body(points, out);
    return cga_not_finite(points, 3);
}

CGA_EXPORT int cga_cooperative_point_degeneracy_gradient_batch(int64_t n, const double *restrict points /* 3 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_degeneracy_gradient(points + k * 3, out + k * 3);
    return bad;
}
