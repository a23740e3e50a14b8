"""The rational fit of 1/√π - x erfcx(x) that Beckmann's masking uses: prints coefficients and the error at 60 digits.

    python benchmarks/ramp.py

Minimax by reweighted linear least squares; the weight is what an error does to x + exp(-x²) (1/√π - x erfcx(x))/2,
which is cos θ (1 + Λ) in units of alpha sin θ.
"""

from mpmath import cos, erfc, exp, lu_solve, matrix, mp, mpf, nstr, pi, sqrt

mp.dps = 60
ABOVE, BELOW, FAR, NODES, ROUNDS = 5, 7, mpf(6), 240, 12


def ramp(x):
    return 1 / sqrt(pi) - x * exp(x * x) * erfc(x)


def fit():
    xs = [FAR * (1 - cos(pi * (2 * i + 1) / (2 * NODES))) / 2 for i in range(NODES)]
    right = [ramp(x) for x in xs]
    weight = [exp(-x * x) / (2 * x + exp(-x * x) * y) for x, y in zip(xs, right, strict=True)]
    below, focus, best = [mpf(1)] * NODES, [mpf(1)] * NODES, None
    for _ in range(ROUNDS):
        a, b = matrix(NODES, ABOVE + 1 + BELOW), matrix(NODES, 1)
        for i, x in enumerate(xs):
            scale = weight[i] * focus[i] / below[i]
            for j in range(ABOVE + 1):
                a[i, j] = scale * x**j
            for j in range(1, BELOW + 1):
                a[i, ABOVE + j] = -scale * right[i] * x**j
            b[i] = scale * right[i]
        found = list(lu_solve(a.T * a, a.T * b))
        p, q = found[: ABOVE + 1], [mpf(1), *found[ABOVE + 1 :]]
        below = [sum(c * x**j for j, c in enumerate(q)) for x in xs]
        errors = [
            abs(sum(c * x**j for j, c in enumerate(p)) / below[i] - right[i]) * weight[i] for i, x in enumerate(xs)
        ]
        if best is None or max(errors) < best[0]:
            best = max(errors), p, q
        mean = sum(errors) / NODES
        focus = [f * sqrt(sqrt((e + mean / 20) / mean)) for f, e in zip(focus, errors, strict=True)]
    return best


if __name__ == "__main__":
    error, p, q = fit()
    print("error", nstr(error, 3), "of x + cos θ Λ; highest power first")
    print([float(c) for c in reversed(p)])
    print([float(c) for c in reversed(q)])
