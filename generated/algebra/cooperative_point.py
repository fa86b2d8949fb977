"""The cooperative point from its points. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it."""


def primitive(points):
    """The primitive X = P1 ^ ... ^ Pk, of line and plane ^ ei, P = e0 + x + x^2/2 ei: its size is the weight (paper A, eq. 14). From cga_codegen.kernels.primitives.primitive.

    Result: shape (5,). 4 mul, 2 add, 0 div, 0 sqrt."""
    t0 = points[0]*points[0]
    t1 = points[1]*points[1]
    t2 = t0+t1
    t3 = points[2]*points[2]
    t4 = t2+t3
    t5 = 0.5*t4
    return (1.0, points[0], points[1], points[2], t5,)


def primitive_jacobian(points):
    """Derivative of the primitive by the points: one factor after the other is replaced by its derivative (paper A, eqs. 15-17). From cga_codegen.kernels.primitives.primitive_jacobian.

    Result: shape (5, 3). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, points[0], points[1], points[2],)


def similarity(points, chart):
    """V with V X_u ~V = X over its weight (paper A, eq. 28). From cga_codegen.kernels.similarity.similarity.

    Result: shape (12,). 3 mul, 0 add, 0 div, 0 sqrt."""
    t0 = 0.5*points[0]
    t1 = 0.5*points[1]
    t2 = 0.5*points[2]
    return (1.0, 0.0, 0.0, 0.0, 0.0, -t0, -t1, 0.0, -t2, 0.0, 0.0, 0.0,)


def parts(points, chart):
    """The factors of V: rotor 1 e12 e13 e23, centre (m), radius (m; 1 of flat ones). From cga_codegen.kernels.similarity.parts.

    Result: shape (8,). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (1.0, 0.0, 0.0, 0.0, points[0], points[1], points[2], 1.0,)


def analytic_jacobian(points, chart):
    """dV = -1/2 V J_G by the points (paper A, eq. 29). From cga_codegen.kernels.similarity.analytic_jacobian.

    Result: shape (12, 3). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,)


def geometric_jacobian(points, chart):
    """J_G = -2 ~V dV by the points, rows e12 e13 e23 e0i e1i e2i e3i, in the primitive's own frame (paper A, eq. 30). From cga_codegen.kernels.similarity.geometric_jacobian.

    Result: shape (7, 3). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0,)


def horizontal_jacobian(points, chart):
    """The geometric Jacobian without the motions that leave the primitive where it is: rows of the controllable blades, others zero. From cga_codegen.kernels.similarity.horizontal_jacobian.

    Result: shape (7, 3). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0,)


def geometric_jacobian_derivative(points, chart, velocities):
    """Time derivative of `geometric_jacobian` where the points move with `velocities` (m/s). From cga_codegen.kernels.similarity.geometric_jacobian_derivative.

    Result: shape (7, 3). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,)


def horizontal_jacobian_derivative(points, chart, velocities):
    """Time derivative of `horizontal_jacobian` where the points move with `velocities` (m/s). From cga_codegen.kernels.similarity.horizontal_jacobian_derivative.

    Result: shape (7, 3). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,)


def degeneracy(points):
    """How far a primitive is from degenerate: |a| (m) of two points, the sine |a x b|/(|a||b|) of three, |det[a, b, d]|/(|a||b||d|) of From cga_codegen.kernels.primitives.degeneracy.

    Result: shape (1,). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (1.0,)


def guard(points):
    """What is looked at before the rest is trusted. Total. From cga_codegen.kernels.primitives.guard.

    Result: shape (4,). 3 mul, 2 add, 0 div, 0 sqrt."""
    t0 = points[0]*points[0]
    t1 = points[1]*points[1]
    t2 = t0+t1
    t3 = points[2]*points[2]
    t4 = t2+t3
    return (1.0, 0.0, 1.0, t4,)


def degeneracy_gradient(points):
    """Derivative of `degeneracy` by the points. From cga_codegen.kernels.primitives.degeneracy_gradient.

    Result: shape (3,). 0 mul, 0 add, 0 div, 0 sqrt."""
    return (0.0, 0.0, 0.0,)
