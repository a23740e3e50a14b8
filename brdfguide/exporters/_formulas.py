"""Every law once, as text that GLSL, OSL, C and Radiance's .cal all take: functions of numbers, without loops or variables.

    ci, cr  cosines to light and view      q  |i_xy + r_xy|²      p  i_xy · r_xy

`choose(c, a, b)` is a where c > 0, else b. Written for float32: sin² of the half vector instead of 1 - cos²,
logarithms of 1 - x from x, no quotient of vanishing numbers. The laws and their sources stand in models/;
erfc is Abramowitz and Stegun 7.1.26 (1.5e-7), Lambert's W is Winitzki's estimate and two steps of Halley.
"""

# (name, arguments, expression); a function may use those above it
FORMULAS = (
    ("sq", "x", "x * x"),
    ("most", "a, b", "choose(a - b, a, b)"),
    ("least", "a, b", "choose(a - b, b, a)"),
    ("ln1m", "x", "choose(0.02 - choose(x, x, -x), -x * (1.0 + x * (0.5 + x * (0.33333333 + x * (0.25 + x * 0.2)))), log(most(1.0 - x, 1.0e-37)))"),
    ("sin2", "c", "(1.0 - c) * (1.0 + c)"),
    ("v2", "ci, cr, q", "sq(ci + cr) + q"),
    ("cos2h", "ci, cr, q", "sq(ci + cr) / v2(ci, cr, q)"),
    ("sin2h", "ci, cr, q", "q / v2(ci, cr, q)"),
    ("tan2h", "ci, cr, q", "q / sq(ci + cr)"),
    ("cosd", "ci, cr, q", "0.5 * sqrt(v2(ci, cr, q))"),
    ("off2", "ci, cr, q", "q + sq(ci - cr)"),
    # Fresnel: |r_s|² = |N² - 1|²/|c + Q|⁴, |r_p/r_s|² = |Qc - s²|²/|Qc + s²|², Q² = x + iy = N² - s²
    ("root", "x, y", "sqrt(0.5 * (sqrt(x * x + y * y) + choose(x, x, -x)))"),
    ("fresnel3", "c, e2, qr, qi", "0.5 * e2 / sq(sq(c + qr) + qi * qi)"
     " * (1.0 + (sq(qr * c - sin2(c)) + sq(qi * c)) / (sq(qr * c + sin2(c)) + sq(qi * c)))"),
    ("fresnel2", "c, e2, x, y", "fresnel3(c, e2, choose(x, root(x, y), 0.5 * y / most(root(x, y), 1.0e-18)),"
     " choose(x, 0.5 * y / most(root(x, y), 1.0e-18), root(x, y)))"),
    ("fresnel", "c, n, k", "fresnel2(c, (sq(n - 1.0) + k * k) * (sq(n + 1.0) + k * k), (n - 1.0) * (n + 1.0) - k * k + c * c, 2.0 * n * k)"),
    ("erfc_by_t", "x, t", "t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))) * exp(-x * x)"),
    ("erfc0", "x", "erfc_by_t(x, 1.0 / (1.0 + 0.3275911 * x))"),
    # bodies
    ("lambertian", "albedo", "albedo / PI"),
    ("through", "x", "x * (5.0 - x * (10.0 - x * (10.0 - x * (5.0 - x))))"),
    ("coupled", "ci, cr, albedo", "albedo * 1.05 / PI * through(ci) * through(cr)"),
    ("oren3", "ci, cr, p, albedo, s2, a, b, cphi", "albedo / PI * (1.0 - 0.5 * s2 / (s2 + 0.33)"
     " + 0.45 * s2 / (s2 + 0.09) * (p / most(ci, cr) - least(cphi, 0.0) * sqrt(sin2(most(ci, cr))) / most(ci, cr) * sq(2.0 * b / PI) * 2.0 * b / PI)"
     " + 0.125 * s2 / (s2 + 0.09) * sq(4.0 * a * b / (PI * PI)) * (1.0 - choose(cphi, cphi, -cphi)) * (sqrt(sin2(ci)) + sqrt(sin2(cr))) / (ci + cr)"
     " + albedo * 0.17 * s2 / (s2 + 0.13) * (1.0 - cphi * sq(2.0 * b / PI)))"),
    ("oren2", "ci, cr, p, albedo, s2, ss", "oren3(ci, cr, p, albedo, s2, acos(least(ci, cr)), acos(most(ci, cr)),"
     " choose(ss - 1.0e-6, most(least(p / most(ss, 1.0e-6), 1.0), -1.0), 0.0))"),
    ("oren_nayar", "ci, cr, p, albedo, spread", "oren2(ci, cr, p, albedo, spread * spread, sqrt(sin2(ci) * sin2(cr)))"),
    ("lost3", "c, s, t, rest", "(1.57079633 - t + t * rest + s * s * c - 0.66666667 * (rest + s * c * (1.0 + s + s * s) / (1.0 + s))) / PI"),
    ("lost", "c", "lost3(c, sqrt(sin2(c)), acos(c), c * c / (1.0 + sqrt(sin2(c))))"),
    ("eon2", "ci, cr, p, albedo, r, a, mean", "a * albedo / PI * (1.0 + r * p / choose(p, most(ci, cr), 1.0))"
     " + a * r * albedo * albedo * mean / (1.0 - albedo * (1.0 - mean)) / PI * lost(ci) * lost(cr) / 0.215305197"),
    ("eon", "ci, cr, p, albedo, r", "eon2(ci, cr, p, albedo, r, 1.0 / (1.0 + 0.287793409 * r), (1.0 + 0.0724882125 * r) / (1.0 + 0.287793409 * r))"),
    # cosine lobes
    ("mirror_lobe", "d2, n", "choose(2.0 - d2, exp(n * ln1m(0.5 * d2)), 0.0)"),
    ("phong", "ci, cr, q, ks, n", "ks * mirror_lobe(off2(ci, cr, q), n) / ci"),
    ("phong_lewis", "ci, cr, q, ks, n", "ks * (n + 2.0) / (2.0 * PI) * mirror_lobe(off2(ci, cr, q), n)"),
    ("blinn", "ci, cr, q, ks, n", "ks * (n + 2.0) * (n + 4.0) / (8.0 * PI * (n + exp(-0.34657359 * n))) * exp(0.5 * n * ln1m(sin2h(ci, cr, q)))"),
    ("lafortune2", "ks, n, less", "choose(1.0 - less, ks * exp(n * ln1m(less)), 0.0)"),
    ("lafortune", "ci, cr, q, ks, n, c1, c2, c3", "lafortune2(ks, n, -(c1 + 0.5 * c2 * off2(ci, cr, q) + c3 * ci * cr))"),
    # Gaussian slopes
    ("ward", "ci, cr, q, rho, a", "rho * exp(-tan2h(ci, cr, q) / (a * a)) / (4.0 * PI * a * a * sqrt(ci * cr))"),
    ("ward_duer", "ci, cr, q, rho, a", "rho * exp(-tan2h(ci, cr, q) / (a * a)) / (4.0 * PI * a * a * ci * cr)"),
    ("ward_gmd", "ci, cr, q, rho, a", "rho * exp(-tan2h(ci, cr, q) / (a * a)) / (PI * a * a * cos2h(ci, cr, q) * sq(ci + cr))"),
    ("gaussian", "ci, cr, q, a", "choose(80.0 * a * a - tan2h(ci, cr, q), exp(-least(tan2h(ci, cr, q) / (a * a), 80.0)) / (PI * a * a * sq(cos2h(ci, cr, q))), 0.0)"),
    ("cook_torrance", "ci, cr, q, a, n, k", "fresnel(cosd(ci, cr, q), n, k) * gaussian(ci, cr, q, a)"
     " * least(1.0, 4.0 * least(ci, cr) * cos2h(ci, cr, q) / (ci + cr)) / (4.0 * ci * cr)"),
    ("lambda_by_x", "x", "0.5 * (exp(-x * x) / (1.7724539 * x) - erfc0(x))"),
    ("lambda", "c, a", "lambda_by_x(c / (a * most(sqrt(sin2(c)), 1.0e-7)))"),
    ("beckmann", "ci, cr, q, a, n, k", "fresnel(cosd(ci, cr, q), n, k) * gaussian(ci, cr, q, a) / (4.0 * ci * cr * (1.0 + lambda(ci, a) + lambda(cr, a)))"),
    ("ggx", "ci, cr, q, a, n, k", "fresnel(cosd(ci, cr, q), n, k) * a * a / (2.0 * PI * sq(cos2h(ci, cr, q) * a * a + sin2h(ci, cr, q)))"
     " / (cr * sqrt(a * a + (1.0 - a * a) * ci * ci) + ci * sqrt(a * a + (1.0 - a * a) * cr * cr))"),
    ("mirror", "ci, n, k, sigma_by_wavelength", "fresnel(ci, n, k) * exp(-sq(4.0 * PI * sigma_by_wavelength * ci))"),
)  # fmt: skip

# He and Torrance: `series` adds exponentials, which each language does its own way
HE_TORRANCE = (
    ("psi", "l", "choose(0.35 - choose(l, l, -l), l * l * (0.5 + l * (0.33333333 + l * (0.125 + l * (0.033333333 + l * (0.0069444444"
     " + l * (0.0011904762 + l * (0.00017361111 + l * 2.2045855e-05))))))), l * exp(l) - exp(l) + 1.0)"),
    ("shift", "m", "(m + 0.5) * log(1.0 + 1.0 / m) - 1.0"),
    ("stirling6", "x", "x * (0.083333333 - x * x * (0.0027777778 - x * x * (0.00079365079 - x * x * 0.00059523810)))"),
    ("stirling", "m", "choose(30.0 - m, shift(m) + shift(m + 1.0) + shift(m + 2.0) + shift(m + 3.0) + shift(m + 4.0) + stirling6(1.0 / (m + 5.0)), stirling6(1.0 / m))"),
    # ln of g^m e^-g e^(-y/m)/(m! m), without differences of large numbers
    ("exponent", "m, g, y", "-g * psi(log(m / g)) - y / m - 1.5 * log(m) - stirling(m) - 0.91893853"),
    ("halley", "w, z", "w - (w - z * exp(-w)) / (1.0 + w - (w - z * exp(-w)) * (2.0 + w) / (2.0 + 2.0 * w))"),
    ("winitzki", "p", "p * (1.0 - log(1.0 + p) / (2.0 + p))"),
    ("lambert_w", "z", "halley(halley(winitzki(log(1.0 + z)), z), z)"),
    # the hump of the terms: u, top g e^u, width
    ("hump_u", "g, y", "0.5 * lambert_w(2.0 * (y / g) / g)"),
    ("hump_width", "top, u", "sqrt(top / (1.0 + 2.0 * u))"),
    ("first_order", "top, w", "most(floor(top - 8.5 * w - 2.0), 1.0)"),
    ("stretched", "t, w, top, u", "1.0 + w * t / ((1.5 + 3.0 * u) * top)"),
    ("node", "t, w, top, u", "top * exp((1.5 + 3.0 * u) * log(stretched(t, w, top, u)))"),
    # one summand over e^high: a whole order (i counts them) of a narrow hump, or a node of the trapezoidal rule over a wide one
    ("order", "i, g, y, u, top, w, high", "exp(exponent(first_order(top, w) + i, g, y) - high)"),
    ("trapezoid", "t, g, y, u, top, w, high", "0.6 * w * node(t, w, top, u) / (top * stretched(t, w, top, u)) * exp(exponent(node(t, w, top, u), g, y) - high)"),
    ("highest", "g, y, top", "exponent(most(top, 1.0), g, y)"),
)
AFTER_SERIES = (
    ("series2", "g, y, u, top", "exp(most(highest(g, y, top), -85.0)) * choose(highest(g, y, top) + 84.0, total(g, y, u, top, hump_width(top, u), highest(g, y, top)), 0.0)"),
    ("series1", "g, y, u", "series2(g, y, u, g * exp(u))"),
    ("series", "g, y", "series1(g, y, hump_u(g, y))"),
    ("steep", "c, slope", "most(2.0 * slope * sqrt(sin2(c)), c / 26.0)"),
    ("visible2", "c, s, e, b", "(2.0 - e) * 1.7724539 / (s * (c / s * (2.0 - e) * 1.7724539 + b))"),
    ("visible1", "c, s", "visible2(c, s, erfc0(c / s), exp(-sq(c / s)))"),
    ("visible", "c, slope", "visible1(c, steep(c, slope))"),
    ("spread", "c, slope", "sqrt(sin2(c)) / c * erfc0(c / steep(c, slope))"),
    ("shadow_free", "k", "1.0 / sqrt(1.0 + lambert_w(k * k / (8.0 * PI)))"),
    ("he_torrance", "ci, cr, q, sigma, tau, slope, n, k", "0.25 * PI * tau * tau * fresnel(cosd(ci, cr, q), n, k) * visible(ci, slope) * visible(cr, slope)"
     " * sq(v2(ci, cr, q) / (ci + cr)) * series(sq(2.0 * PI * sigma * (ci + cr) * shadow_free(spread(ci, slope) + spread(cr, slope))), sq(PI * tau) * q)"),
    ("he_mirror", "ci, sigma, slope, n, k", "fresnel(ci, n, k) * sq(visible(ci, slope) * ci)"
     " * exp(-least(sq(4.0 * PI * sigma * ci * shadow_free(2.0 * spread(ci, slope))), 85.0))"),
)  # fmt: skip
