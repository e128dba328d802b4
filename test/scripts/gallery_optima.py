# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The optima of the gallery's machines by other means: closed forms, or a few lines of linear algebra, without this package.

Each function has the name of its machine, its formula and its source, and returns {name: (value, relative tolerance)} of tuned parameters, and of the
`objective` where that is what is known. A tolerance covers what the formula leaves out: motions that are small but not infinitely so, runs that end.
"""
from math import acosh, atan, cos, exp, log, pi, radians, sin, sqrt, tan

G = 9.81


def solve(matrix, right):
    """The solution X of A X = B, both as lists of rows, by Gauss and Jordan."""
    n, rows = len(matrix), [list(map(float, a)) + list(map(float, b)) for a, b in zip(matrix, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k, i=i: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for k in range(n):
            if k != i:
                rows[k] = [x - rows[k][i] * y for x, y in zip(rows[k], rows[i])]
    return [row[n:] for row in rows]


def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def transposed(a):
    return [list(column) for column in zip(*a)]


def identity(n):
    return [[float(i == j) for j in range(n)] for i in range(n)]


def least(function, start):
    """The place of the minimum of a function of some numbers near `start`, by Newton's method with differences. A step changes no number by more than
    a fifth."""
    x, n = list(start), len(start)

    def moved(*steps):
        return function(*(value * (1.0 + 1e-4 * sum(sign for k, sign in steps if k == i)) for i, value in enumerate(x)))

    for _ in range(20):
        slope = [[-(moved((i, 1)) - moved((i, -1))) / 2e-4] for i in range(n)]
        curvature = [[(moved((i, 1), (j, 1)) - moved((i, 1), (j, -1)) - moved((i, -1), (j, 1)) + moved((i, -1), (j, -1))) / 4e-8 for j in range(n)]
                     for i in range(n)]
        x = [value * (1.0 + max(-0.2, min(0.2, step))) for value, (step,) in zip(x, solve(curvature, slope))]
    return x


def regulator(A, b, q, r):
    """Gains K of u = -K x that minimize the integral of sum q_i x_i^2 + r u^2, x' = A x + b u: Riccati's equation by the matrix sign function of its
    Hamiltonian matrix (J. D. Roberts, International Journal of Control 32, 1980)."""
    n = len(A)
    H = [A[i] + [-b[i] * b[j] / r for j in range(n)] for i in range(n)]
    H += [[-q[i] * (i == j) for j in range(n)] + [-A[j][i] for j in range(n)] for i in range(n)]
    for _ in range(60):
        inverse = solve(H, identity(2 * n))
        H = [[0.5 * (x + y) for x, y in zip(*rows)] for rows in zip(H, inverse)]
    # (W11 + I; W21) + (W12; W22 + I) P = 0, of full column rank: by its normal equations.
    left = [[H[i][n + j] + (i == n + j) for j in range(n)] for i in range(2 * n)]
    right = [[-H[i][j] - (i == j) for j in range(n)] for i in range(2 * n)]
    P = solve(product(transposed(left), left), product(transposed(left), right))
    return [sum(b[i] * P[i][j] for i in range(n)) / r for j in range(n)]


def state_space(mass, stiffness, force):
    """A and b of M q'' + K q = f u in the states q, q' of two coordinates."""
    accelerations = solve(mass, [[-x for x in row] + [f] for row, f in zip(stiffness, force)])
    A = [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]] + [row[:2] + [0.0, 0.0] for row in accelerations]
    return A, [0.0, 0.0] + [row[2] for row in accelerations]


def gains(found, tolerance):
    return {f"K{k + 1}": (value, tolerance) for k, value in enumerate(found)}


def spring_balanced_arm():
    """A spring of zero free length between a point at a above the pivot and one at b along the arm has the moment k a b sin(angle), gravity m g l
    sin(angle): k = m g l/(a b). French and Widden, Proc. IMechE C 214, 2000."""
    return {"stiffness": (4.0 * G * 0.5 / (0.3 * 0.2), 1e-5)}


def hoist_gear():
    """The acceleration (n T - m g)/(m + n^2 J) is largest at n = m g/T + sqrt((m g/T)^2 + m/J); n = gear/0.1 m."""
    weight = 100.0 * G / 20.0
    return {"gear": (0.1 * (weight + sqrt(weight ** 2 + 100.0 / 0.02)), 1e-4)}


def quarter_car():
    """The mean square of the body's acceleration over white noise is proportional to (m_b + m_w) k^2/c + c k_t, least at c = k sqrt((m_b + m_w)/k_t).
    Gobbi and Mastinu, Journal of Sound and Vibration 245, 2001."""
    return {"damper": (2e4 * sqrt((300.0 + 40.0) / 2e5), 1e-4)}


def cart_pole():
    """Riccati's gains of the mechanism, linear about the upright pole."""
    m, arm, inertia = 0.2, 0.25, 0.004
    A, b = state_space([[1.0 + m, m * arm], [m * arm, inertia + m * arm ** 2]], [[0.0, 0.0], [0.0, -m * G * arm]], [1.0, 0.0])
    return gains(regulator(A, b, [1e4, 1e4, 0.0, 0.0], 1e3), 2e-3)


def furuta_pendulum():
    """Riccati's gains of the mechanism, linear about the upright pole. Its tip moves by radius * turn - arm * tilt."""
    m, arm, radius = 0.1, 0.15, 0.2
    turn = 2e-3 + 0.3 * 0.1 ** 2 + 1e-6 + m * radius ** 2
    A, b = state_space([[turn, -m * radius * arm], [-m * radius * arm, 1e-3 + m * arm ** 2]], [[0.0, 0.0], [0.0, -m * G * arm]], [1.0, 0.0])
    return gains(regulator(A, b, [1e4, 1e4, 0.0, 0.0], 1e6), 2e-3)


def scara_cost(p, i, d):
    """The objective of `scara`: a mass under a force that changes at the instants k T + delay moves along parabolas, so that each piece of the
    integral is a polynomial of degree four, for which Gauss's rule of three points is exact."""
    mass, period, delay, goal, horizon = 0.6 + 300.0 ** 2 * 1e-5, 0.004, 0.002, 0.02, 0.4
    x = v = force = integral = last = cost = 0.0

    def advance(duration):
        nonlocal x, v, cost
        a = force / mass - 0.6 * G / mass
        for node, weight in ((-sqrt(0.6), 5.0), (0.0, 8.0), (sqrt(0.6), 5.0)):
            t = 0.5 * duration * (1.0 + node)
            cost += duration * weight / 18.0 * (1e6 * (goal - x - v * t - 0.5 * a * t * t) ** 2 + 0.02 * (force - 5.886) ** 2)
        x, v = x + v * duration + 0.5 * a * duration ** 2, v + a * duration

    for k in range(round(horizon / period)):
        error = goal - x
        integral += period * error
        rate = 0.0 if k == 0 else (error - last) / period
        last = error
        advance(delay)
        force = p * error + i * integral + d * rate
        advance(period - delay)
    return cost


def scara():
    """The least cost of the difference equation of the sampled loop."""
    found = least(scara_cost, [4000.0, 10000.0, 100.0])
    return {name: (value, 2e-3) for name, value in zip(("Kp", "Ki", "Kd"), found)} | {"objective": (scara_cost(*found), 1e-4)}


def delta_robot():
    """Virtual work: the springs k (angle - free) of all three arms carry the platform, whose height h below the base follows from the rods, and the
    arms. Two angles give two equations."""
    base, arm, rod, platform, centre = 0.2, 0.2, 0.45, 0.05, 0.1

    def torque(angle):
        reach = base + arm * cos(angle) - platform
        slope = arm * cos(angle) + reach * arm * sin(angle) / sqrt(rod ** 2 - reach ** 2)
        return (1.0 * G * slope + 3.0 * 0.5 * G * centre * cos(angle)) / 3.0

    pick, place = 0.2, -0.4
    stiffness = (torque(pick) - torque(place)) / (pick - place)
    return {"stiffness": (stiffness, 1e-4), "free_angle": (pick - torque(pick) / stiffness, 1e-4)}


def ball_screw_axis():
    """With p = lead/(2 pi) the torque is (m p + J/p) a + m g p. The acceleration of a move from rest to rest has the mean zero; its square has the
    integral A = 120/7 d^2/T^3 for a quintic. So p^4 = (J/m)^2 A/(A + g^2 T)."""
    A = 120.0 / 7.0 * 0.4 ** 2 / 0.5 ** 3
    return {"lead": (2.0 * pi * sqrt(1e-3 / 50.0) * (A / (A + G ** 2 * 0.5)) ** 0.25, 1e-4)}


def door_closer():
    """Of J x'' + c x' + k x = 0 from x0 at rest, with w^2 = k/J and c = 2 z w J: the integral of x^2 is x0^2 (1 + 4 z^2)/(4 z w), and for z > 1 the
    largest speed is x0 w exp(-z acosh(z)/sqrt(z^2 - 1)). At the limit of speed, the product of both is to be least over z."""
    inertia, start, speed = 1.36 + 20.0 * 0.45 ** 2, 1.5, 1.0

    def peak(z):
        return start * exp(-z * acosh(z) / sqrt(z * z - 1.0))

    (z,) = least(lambda x: peak(x) * (1.0 + 4.0 * x * x) / (4.0 * x), [1.3])
    w = speed / peak(z)
    return {"stiffness": (inertia * w * w, 1e-3), "damper": (2.0 * z * w * inertia, 1e-3),
            "objective": (start ** 2 * (1.0 + 4.0 * z * z) / (4.0 * z * w), 1e-5)}


def gantry_crane():
    """The least integral of u^2 that leads x' = A x + b u from rest to x1 within T is x1' W^-1 x1 with the Gramian W of (A, b). Its spline comes close."""
    M, m, length, inertia, duration = 4.0, 2.0, 0.6, 0.01, 2.5
    A, b = state_space([[M + m, m * length], [m * length, inertia + m * length ** 2]], [[0.0, 0.0], [0.0, m * G * length]], [1.0, 0.0])
    steps = 2000  # Simpson's rule; exp(A t) b by Taylor's series of one step.
    h, state, gramian = duration / steps, list(b), [[0.0] * 4 for _ in range(4)]
    for k in range(steps + 1):
        weight = h / 3.0 * (1 if k in (0, steps) else 4 if k % 2 else 2)
        gramian = [[w + weight * x * y for w, y in zip(row, state)] for row, x in zip(gramian, state)]
        term = list(state)
        for order in range(1, 9):
            term = [h / order * sum(x * y for x, y in zip(row, term)) for row in A]
            state = [x + y for x, y in zip(state, term)]
    goal = [0.1, 0.0, 0.0, 0.0]
    multipliers = solve(gramian, [[x] for x in goal])
    return {"objective": (sum(x * y[0] for x, y in zip(goal, multipliers)), 2e-3)}


def vendor_arm():
    """At least integral of a^2 the speed is a parabola up to the limit V within t1, then V, then a parabola to rest: d = V (T - 2 t1/3), and the
    integral is 8 V^2/(3 t1)."""
    distance, duration, speed = 5.25, 2.0, 3.15
    t1 = 1.5 * (duration - distance / speed)
    return {"objective": (8.0 * speed ** 2 / (3.0 * t1), 1e-3)}


def swinging_leg():
    """The swing (1, 1/2) cos(w t) is an eigenvector: (K + G - w^2 M) (1, 1/2) = 0 with the springs K, gravity G and inertia M of the linear leg."""
    m1, c1, i1, length, m2, c2, i2 = 7.0, 0.18, 0.1, 0.42, 4.0, 0.2, 0.06
    w2 = (2.0 * pi * 1.2) ** 2
    coupled = i2 + m2 * (c2 ** 2 + length * c2)
    inertia = ((i1 + m1 * c1 ** 2 + i2 + m2 * (length ** 2 + c2 ** 2 + 2.0 * length * c2), coupled), (coupled, i2 + m2 * c2 ** 2))
    weight = ((m1 * G * c1 + m2 * G * (length + c2), m2 * G * c2), (m2 * G * c2, m2 * G * c2))
    hip, knee = (sum((w2 * i - g) * x for i, g, x in zip(*rows, (1.0, 0.5))) for rows in zip(inertia, weight))
    return {"hip_spring": (hip, 5e-4), "knee_spring": (knee / 0.5, 5e-4)}


def toggle_press():
    """The link whose foot leans by `a` carries F = P/(2 tan a) at the ram; sin a = offset/length."""
    return {"link": (0.05 / sin(atan(1000.0 / (2.0 * 5000.0))), 1e-5)}


def quick_return_shaper():
    """The lever turns back where the crank is at a right angle to it, at sin(swing) = crank/distance; the cut takes pi + 2 swing of a turn, the return
    pi - 2 swing. Twice as long: swing = 30 degrees. The ram's stroke is 2 height tan(swing). The crank's speed varies a little."""
    return {"crank_length": (0.3 * sin(pi / 6.0), 5e-4), "ram_height": (0.3 / tan(pi / 6.0), 5e-4)}


def function_generator():
    """Freudenstein's equation K1 cos(output) - K2 cos(input) + K3 = cos(input - output) at three precision points, with K1 = ground/crank, K2 =
    ground/rocker, K3 = (crank^2 - coupler^2 + rocker^2 + ground^2)/(2 crank rocker). Freudenstein, Trans. ASME 77, 1955."""
    ground = 0.1
    places = [1.5 - 0.5 * cos(pi / 6.0 + k * pi / 3.0) for k in range(3)]
    angles = [(radians(115.0 + 90.0 * (x - 1.0)), radians(90.0 + 60.0 * log(x) / log(2.0))) for x in places]
    (k1,), (k2,), (k3,) = solve([[cos(o), -cos(i), 1.0] for i, o in angles], [[cos(i - o)] for i, o in angles])
    crank, rocker = ground / k1, ground / k2
    coupler = sqrt(crank ** 2 + rocker ** 2 + ground ** 2 - 2.0 * crank * rocker * k3)
    return {"crank": (crank, 1e-5), "coupler": (coupler, 1e-5), "rocker": (rocker, 1e-5)}


def straight_line_four_bar():
    """Chebyshev's proportions 4 : 5 : 2 of base, rockers and coupler."""
    return {"rocker": (0.5, 1e-5), "coupler": (0.2, 1e-5)}


def sticking_drawer():
    """The couple P e is carried by 2 P e/guide at the ends of the guides, on which m g rests: m a = P - mu (2 P e/guide + m g)."""
    m, pull, offset, mu, acceleration = 5.0, 30.0, 0.2, 0.2, 1.0
    return {"guide": (2.0 * mu * pull * offset / (pull - m * acceleration - mu * m * G), 1e-3)}


def cam_drive():
    """The force on the cam is m y'' + k (y - free) + m g with y = e cos(w t): constant for k = m w^2, and then m g - k free."""
    stiffness = 0.5 * (10.0 * pi) ** 2
    return {"stiffness": (stiffness, 1e-3), "free_position": (-(20.0 - 0.5 * G) / stiffness, 1e-3)}
