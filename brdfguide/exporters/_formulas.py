"""What laws are written with for GLSL, OSL, C and Radiance's .cal: functions of numbers, without loops or variables.

    ci, cr  cosines to light and view      q  |i_xy + r_xy|²      p  i_xy · r_xy

`choose(c, a, b)` is a where c > 0, else b. Written for float32: sin² of the half vector instead of 1 - cos²,
logarithms of 1 - x from x, no quotient of vanishing numbers. Each law's own text stands in its file in models/;
erfc is Abramowitz and Stegun 7.1.26 (1.5e-7), Lambert's W is Winitzki's estimate and two steps of Halley.
"""

# (name, arguments, expression)
FORMULAS = (
    ("sq", "x", "x * x"),
    ("most", "a, b", "choose(a - b, a, b)"),
    ("least", "a, b", "choose(a - b, b, a)"),
    (
        "ln1m",
        "x",
        (
            "choose(0.02 - choose(x, x, -x), -x * (1.0 + x * (0.5 + x * (0.33333333 + x * (0.25 + x * 0.2)))), "
            "log(most(1.0 - x, 1.0e-37)))"
        ),
    ),
    ("sin2", "c", "(1.0 - c) * (1.0 + c)"),
    ("v2", "ci, cr, q", "sq(ci + cr) + q"),
    ("cos2h", "ci, cr, q", "sq(ci + cr) / v2(ci, cr, q)"),
    ("sin2h", "ci, cr, q", "q / v2(ci, cr, q)"),
    ("tan2h", "ci, cr, q", "q / sq(ci + cr)"),
    ("cosd", "ci, cr, q", "0.5 * sqrt(v2(ci, cr, q))"),
    ("off2", "ci, cr, q", "q + sq(ci - cr)"),
    # Fresnel: |r_s|² = |N² - 1|²/|c + Q|⁴, |r_p/r_s|² = |Qc - s²|²/|Qc + s²|², Q² = x + iy = N² - s²
    ("root", "x, y", "sqrt(0.5 * (sqrt(x * x + y * y) + choose(x, x, -x)))"),
    (
        "fresnel3",
        "c, e2, qr, qi",
        "0.5 * e2 / sq(sq(c + qr) + qi * qi)"
        " * (1.0 + (sq(qr * c - sin2(c)) + sq(qi * c)) / (sq(qr * c + sin2(c)) + sq(qi * c)))",
    ),
    (
        "fresnel2",
        "c, e2, x, y",
        "fresnel3(c, e2, choose(x, root(x, y), 0.5 * y / most(root(x, y), 1.0e-18)),"
        " choose(x, 0.5 * y / most(root(x, y), 1.0e-18), root(x, y)))",
    ),
    (
        "fresnel",
        "c, n, k",
        (
            "fresnel2(c, (sq(n - 1.0) + k * k) * (sq(n + 1.0) + k * k), (n - 1.0) * (n + 1.0) - k * k + c * c, "
            "2.0 * n * "
            "k)"
        ),
    ),
    (
        "erfc_by_t",
        "x, t",
        (
            "t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))) * "
            "exp(-x "
            "* x)"
        ),
    ),
    ("erfc0", "x", "erfc_by_t(x, 1.0 / (1.0 + 0.3275911 * x))"),
    # what several laws share
    ("mirror_lobe", "d2, n", "choose(2.0 - d2, exp(n * ln1m(0.5 * d2)), 0.0)"),
    (
        "gaussian",
        "ci, cr, q, a",
        (
            "choose(80.0 * a * a - tan2h(ci, cr, q), exp(-least(tan2h(ci, cr, q) / (a * a), 80.0)) / (PI * a * a * "
            "sq(cos2h(ci, cr, q))), 0.0)"
        ),
    ),
)

# `series(g, y)`, the sum over m of g^m e^-g/(m! m) e^(-y/m), adds exponentials, which each language does its own way in
# `total`: (name, arguments, what it calls)
TOTAL = ("total", "g, y, u, top, w, high", "order() trapezoid() first_order()")
SERIES = (
    (
        "psi",
        "l",
        "choose(0.35 - choose(l, l, -l), l * l * (0.5 + l * (0.33333333 + l * (0.125 + l * (0.033333333 + l * "
        "(0.0069444444"
        " + l * (0.0011904762 + l * (0.00017361111 + l * 2.2045855e-05))))))), l * exp(l) - exp(l) + 1.0)",
    ),
    ("shift", "m", "(m + 0.5) * log(1.0 + 1.0 / m) - 1.0"),
    ("stirling6", "x", "x * (0.083333333 - x * x * (0.0027777778 - x * x * (0.00079365079 - x * x * 0.00059523810)))"),
    (
        "stirling",
        "m",
        (
            "choose(30.0 - m, shift(m) + shift(m + 1.0) + shift(m + 2.0) + shift(m + 3.0) + shift(m + 4.0) + "
            "stirling6(1.0 / (m + 5.0)), stirling6(1.0 / m))"
        ),
    ),
    # ln of g^m e^-g e^(-y/m)/(m! m), without differences of large numbers
    ("exponent", "m, g, y", "-g * psi(log(m / g)) - y / m - 1.5 * log(m) - stirling(m) - 0.91893853"),
    ("halley", "w, z", "w - (w - z * exp(-w)) / (1.0 + w - (w - z * exp(-w)) * (2.0 + w) / (2.0 + 2.0 * w))"),
    ("winitzki", "p", "p * (1.0 - log(1.0 + p) / (2.0 + p))"),
    ("lambert_w", "z", "halley(halley(winitzki(log(1.0 + z)), z), z)"),
    # the peak of the summand: u, top g e^u, width
    ("peak_u", "g, y", "0.5 * lambert_w(2.0 * (y / g) / g)"),
    ("peak_width", "top, u", "sqrt(top / (1.0 + 2.0 * u))"),
    ("first_order", "top, w", "most(floor(top - 8.5 * w - 2.0), 1.0)"),
    ("stretched", "t, w, top, u", "1.0 + w * t / ((1.5 + 3.0 * u) * top)"),
    ("node", "t, w, top, u", "top * exp((1.5 + 3.0 * u) * log(stretched(t, w, top, u)))"),
    # one summand over e^high: a whole order (i counts them) of a narrow peak, or a node of the trapezoidal rule over
    # a wide one
    ("order", "i, g, y, u, top, w, high", "exp(exponent(first_order(top, w) + i, g, y) - high)"),
    (
        "trapezoid",
        "t, g, y, u, top, w, high",
        (
            "0.6 * w * node(t, w, top, u) / (top * stretched(t, w, top, u)) * exp(exponent(node(t, w, top, u), g, y) "
            "- high)"
        ),
    ),
    ("highest", "g, y, top", "exponent(most(top, 1.0), g, y)"),
    TOTAL,
    (
        "series2",
        "g, y, u, top",
        (
            "exp(most(highest(g, y, top), -85.0)) * choose(highest(g, y, top) + 84.0, total(g, y, u, top, "
            "peak_width(top, u), highest(g, y, top)), 0.0)"
        ),
    ),
    ("series1", "g, y, u", "series2(g, y, u, g * exp(u))"),
    ("series", "g, y", "series1(g, y, peak_u(g, y))"),
)
