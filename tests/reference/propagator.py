#!/usr/bin/env python3
"""Reference values for the tests of solver/src/dynamics/integration/propagator.rs, in 60-digit arithmetic.

The linear system of those tests, two modes beside a circuit that is 1e7 times faster, is carried over a step under a
polynomial rest force by the exponential of an augmented matrix: the polynomial's monomials are added to the state
vector. That is another formula than the program's, and another arithmetic.

    python3 tests/reference/propagator.py        (seconds; needs mpmath)
"""

from mpmath import expm, matrix, mp, mpf, polyroots

mp.dps = 60
N, NODES, STEP = 2, 8, mpf("0.3125")
WIDTH = 2 * N + 3
STIFFNESS, DAMPING = [mpf(16), mpf(400)], [mpf(0.016), mpf(0.4)]
INVERSE_MASS, DRIVE, THETA = [mpf("3.5"), mpf("3.25")], [mpf("1.5"), mpf("-0.75")], [mpf("0.0125"), mpf("0.046875")]
MUTUAL, ELASTANCE, KAPPA, OMEGA = mpf(0.00125), mpf(10) ** 9, mpf(0.01), mpf(1)

a, force = matrix(WIDTH, WIDTH), matrix(WIDTH, 1)
for k in range(N):
    a[k, N + k] = 1
    a[N + k, k] = -STIFFNESS[k]
    for j in range(N):
        a[N + k, N + j] = INVERSE_MASS[k] * MUTUAL
    a[N + k, N + k] -= DAMPING[k]
    a[N + k, 2 * N] = -INVERSE_MASS[k] * THETA[k]
    a[N + k, 2 * N + 1] = DRIVE[k]
    a[2 * N, N + k] = THETA[k] * ELASTANCE
    force[N + k] = -INVERSE_MASS[k]
a[2 * N, 2 * N] = -KAPPA * ELASTANCE
a[2 * N + 1, 2 * N + 2] = OMEGA
a[2 * N + 2, 2 * N + 1] = -OMEGA
rate_row = a[2 * N, :]

# The roots of the Legendre polynomial of degree eight.
roots = polyroots([6435, 0, -12012, 0, 6930, 0, -1260, 0, 35], maxsteps=200, extraprec=200)
nodes = sorted((1 + mp.re(root)) / 2 for root in roots)
vandermonde = matrix(NODES, NODES)
for l, x in enumerate(nodes):
    for k in range(NODES):
        vandermonde[l, k] = x**k / mp.factorial(k)
to_monomials = vandermonde**-1


def flow(x):
    """From the state at the start and R at the nodes to the state at the fraction x of the step."""
    columns = matrix(WIDTH, WIDTH + NODES)
    columns[:, :WIDTH] = expm(a * STEP * x, method="taylor")
    powers = matrix(WIDTH, NODES)
    for k in range(NODES):
        powers[:, k] = response(x, k)
    columns[:, WIDTH:] = powers * to_monomials
    return columns


def response(x, k):
    """To R = x^k / k!: a chain of k + 1 added entries, of which the first is 1 and each drives the next."""
    b = matrix(WIDTH + k + 1, WIDTH + k + 1)
    b[:WIDTH, :WIDTH] = a * STEP
    b[:WIDTH, WIDTH + k] = force * STEP
    for j in range(k):
        b[WIDTH + j + 1, WIDTH + j] = 1
    return expm(b * x, method="taylor")[:WIDTH, WIDTH]


def show(name, rows, columns):
    print(f"const {name}: [[f64; {columns}]; {len(rows)}] = [")
    for row in rows:
        print("    [" + ", ".join(mp.nstr(entry, 15) for entry in row) + "],")
    print("];")


end = flow(mpf(1))
show("END", [[end[i, j] for i in range(2 * N + 1)] for j in range(WIDTH + NODES)], 2 * N + 1)
middle = flow(nodes[4])
tip = [middle[0, j] + middle[1, j] for j in range(WIDTH + NODES)]
voltage = [middle[2 * N, j] for j in range(WIDTH + NODES)]
rate = [sum(rate_row[0, i] * middle[i, j] for i in range(WIDTH)) for j in range(WIDTH + NODES)]
show("FIFTH_NODE", [[tip[j], voltage[j], rate[j]] for j in range(WIDTH + NODES)], 3)
