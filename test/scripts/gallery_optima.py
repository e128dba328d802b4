# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The optima of the gallery's machines by other means: closed forms, or a few lines of linear algebra, without this package.

Each function has the name of its machine, its formula and its source, and returns {name: (value, relative tolerance)} of tuned parameters, and of the
`objective` where that is what is known. A tolerance covers what the formula leaves out: motions that are small but not infinitely so, runs that end.
"""
from math import acos, acosh, atan, atan2, cos, exp, hypot, log, pi, radians, sin, sqrt, tan

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
    return {"stiffness": (4.0 * G * 0.5 / (0.3 * 0.2), 1e-9)}


def hoist_gear(efficiency=0.8):
    """Of the efficiency e, the acceleration (e n T - m g)/(m + e n^2 J) is largest at n = m g/(e T) + sqrt((m g/(e T))^2 + m/(e J)); n = gear/0.1 m."""
    weight = 100.0 * G / (efficiency * 20.0)
    return {"gear": (0.1 * (weight + sqrt(weight ** 2 + 100.0 / (efficiency * 0.02))), 1e-4)}


def lift_heat(T):
    """The least integral of F^2 of a ride of 3 m from rest to rest in the time T, times 1e-5: W^2 T + 12 M^2 h^2/T^3."""
    return 1e-5 * ((120.0 * G) ** 2 * T + 12.0 * (1120.0 * 3.0) ** 2 / T ** 3)


def goods_lift():
    """Its minimum is at T^4 = 36 M^2 h^2/W^2, with F = W + 6 M h/T^2 (1 - 2t/T) = 2 W (1 - t/T)."""
    T = sqrt(6.0 * 1120.0 * 3.0 / (120.0 * G))
    return {"T": (T, 1e-4), "a": (0.24 * G, 1e-3), "b": (-0.24 * G, 2e-3), "objective": (lift_heat(T), 1e-6)}


def quarter_car_on_a_step():
    """The mean square of the body's acceleration over white noise is proportional to (m_b + m_w) k^2/c + c k_t, least at c = k sqrt((m_b + m_w)/k_t).
    Gobbi and Mastinu, Journal of Sound and Vibration 245, 2001."""
    return 2e4 * sqrt((300.0 + 40.0) / 2e5)


def shaken(damper, rise):
    """The integral of the square of the body's acceleration after the step 1 - (1 + t/rise) exp(-t/rise) of the road, but for a factor: over the
    frequencies w = 100 tan(x)/s, by the rule of midpoints."""
    body, wheel, spring, tyre, count, total = 300.0, 40.0, 2e4, 2e5, 2000, 0.0
    for k in range(count):
        w = 100.0 * tan(0.5 * pi * (k + 0.5) / count)
        s = 1j * w
        strut = damper * s + spring
        answer = s * tyre * strut / ((body * s * s + strut) * (wheel * s * s + tyre + strut) - strut * strut)
        total += abs(answer) ** 2 / (1.0 + (rise * w) ** 2) ** 2 * (1.0 + (w / 100.0) ** 2)
    return total


def quarter_car():
    """The least integral over the frequencies, near the formula of a step."""
    (damper,) = least(lambda c: shaken(c, 1e-3), [quarter_car_on_a_step()])
    return {"damper": (damper, 5e-5)}


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


def scara_cost(p, i, d, period=0.004, delay=0.002):
    """The objective of `scara`: a mass under a force that changes at the instants k T + delay moves along parabolas, so that each piece of the
    integral is a polynomial of degree four, for which Gauss's rule of three points is exact."""
    mass, goal, horizon = 0.6 + 300.0 ** 2 * 1e-5, 0.02, 0.4
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


DELTA_TIMES = (0.0, 0.08, 0.2, 0.32, 0.4)
DELTA_POINTS = ((-0.15, -0.05, -0.42), (-0.12, -0.04, -0.395), (0.0, 0.0, -0.37), (0.12, 0.04, -0.385), (0.15, 0.05, -0.41))
DELTA_ARMS = [(cos(2.0 * pi * k / 3.0), sin(2.0 * pi * k / 3.0)) for k in range(3)]
DELTA_BASE, DELTA_ARM, DELTA_ROD, DELTA_PLATFORM = 0.2, 0.2, 0.45, 0.05


def delta_angles(point):
    """The angle of each motor at a point of the platform: a cos(angle) - z sin(angle) = k in the plane of the arm, the elbow outside."""
    angles = []
    for c, s in DELTA_ARMS:
        a, b = c * point[0] + s * point[1] + DELTA_PLATFORM - DELTA_BASE, c * point[1] - s * point[0]
        k = (a * a + b * b + point[2] ** 2 + DELTA_ARM ** 2 - DELTA_ROD ** 2) / (2.0 * DELTA_ARM)
        angles.append(atan2(-point[2], a) - acos(k / hypot(a, point[2])))
    return angles


def quintics(times, values):
    """Value, rate and acceleration as a function of the time, on polynomials of degree five between way-points: at rest at both ends; the velocity in
    between is that of the parabola through three points, the acceleration the mean of those of the two cubics that meet. doc/theory.md (C2)."""
    knots = [[x, 0.0, 0.0] for x in values]
    inner = [(k, times[k] - times[k - 1], times[k + 1] - times[k]) for k in range(1, len(times) - 1)]
    for k, before, after in inner:
        knots[k][1] = (after * (values[k] - values[k - 1]) / before + before * (values[k + 1] - values[k]) / after) / (before + after)
    for k, before, after in inner:
        left = (2.0 * knots[k - 1][1] + 4.0 * knots[k][1] - 6.0 * (values[k] - values[k - 1]) / before) / before
        right = (6.0 * (values[k + 1] - values[k]) / after - 4.0 * knots[k][1] - 2.0 * knots[k + 1][1]) / after
        knots[k][2] = 0.5 * (left + right)

    def powers(t):
        """The rows of 1, t, ..., t^5 and of their first two derivatives."""
        return [[t ** n for n in range(6)], [n * t ** max(n - 1, 0) for n in range(6)], [n * (n - 1) * t ** max(n - 2, 0) for n in range(6)]]

    pieces = [solve(powers(0.0) + powers(times[k + 1] - times[k]), [[x] for x in knots[k] + knots[k + 1]]) for k in range(len(times) - 1)]

    def at(t):
        k = max(k for k in range(len(pieces)) if t >= times[k])
        return [row[0] for row in product(powers(t - times[k]), pieces[k])]

    return at


def dot(x, y):
    return sum(a * b for a, b in zip(x, y))


def delta_torques(motion, mass, near):
    """Torques of the motors without springs, of (angle, rate, acceleration) of each, and the place of the platform, by Newton's method from a place
    `near`. The constant lengths of the rods, place - tip, give velocity and acceleration of the platform; the forces of the rods carry m (a + g)."""
    # The tip of each arm, seen from the middle of the platform, and its derivatives by the angle: towards the arm and up.
    planes = [((DELTA_BASE - DELTA_PLATFORM + DELTA_ARM * cos(x), -DELTA_ARM * sin(x)), (-DELTA_ARM * sin(x), -DELTA_ARM * cos(x)),
               (-DELTA_ARM * cos(x), DELTA_ARM * sin(x))) for x, _, _ in motion]
    tips, slopes, bends = ([[u * c, u * s, v] for (u, v), (c, s) in zip(ends, DELTA_ARMS)] for ends in zip(*planes))
    place = list(near)
    for _ in range(6):
        rods = [[p - q for p, q in zip(place, tip)] for tip in tips]
        place = [p + d for p, (d,) in zip(place, solve(rods, [[0.5 * (DELTA_ROD ** 2 - dot(rod, rod))] for rod in rods]))]
    levers = [dot(*pair) for pair in zip(rods, slopes)]
    velocity = [v for v, in solve(rods, [[lever * rate] for lever, (_, rate, _) in zip(levers, motion)])]
    turns = [[v - rate * e for v, e in zip(velocity, slope)] for slope, (_, rate, _) in zip(slopes, motion)]
    acceleration = solve(rods, [[lever * a + dot(rod, bend) * rate ** 2 - dot(turn, turn)]
                                for lever, rod, bend, turn, (_, rate, a) in zip(levers, rods, bends, turns, motion)])
    forces = solve(transposed(rods), [[mass * (a + g)] for (a,), g in zip(acceleration, (0.0, 0.0, G))])
    arm, centre, inertia = 0.5, 0.1, 2e-3
    return [force * lever + (inertia + arm * centre ** 2) * a - arm * G * centre * cos(angle)
            for (force,), lever, (angle, _, a) in zip(forces, levers, motion)], place


def delta_samples():
    """(weight of Simpson's rule, angle, torque) of each motor at each instant: of the move with half a kilogram, and of that without."""
    courses = [quintics(DELTA_TIMES, angles) for angles in zip(*map(delta_angles, DELTA_POINTS))]
    steps, moves = 400, []
    for mass in (1.5, 1.0):
        place, samples = DELTA_POINTS[0], []
        for k in range(steps + 1):
            motion = [course(DELTA_TIMES[-1] * k / steps) for course in courses]
            torques, place = delta_torques(motion, mass, place)
            weight = DELTA_TIMES[-1] / (3.0 * steps) * (1 if k in (0, steps) else 4 if k % 2 else 2)
            samples += [(weight, angle, torque) for (angle, _, _), torque in zip(motion, torques)]
        moves.append(samples)
    return moves


def delta_robot():
    """Virtual work along the given motion. Stiffness k and free angle f add k angle - k f to the torque of a motor, which is linear in k and k f: the
    least mean integral of the squares is a problem of linear least squares."""
    samples = [sample for move in delta_samples() for sample in move]

    def mean(term):
        return 0.5 * sum(weight * term(angle, torque) for weight, angle, torque in samples)

    (k,), (tension,) = solve([[mean(lambda x, _: x * x), -mean(lambda x, _: x)], [-mean(lambda x, _: x), mean(lambda *_: 1.0)]],
                             [[-mean(lambda x, torque: x * torque)], [mean(lambda _, torque: torque)]])
    return {"stiffness": (k, 1e-5), "free_angle": (tension / k, 1e-5), "objective": (mean(lambda x, torque: (torque + k * x - tension) ** 2), 1e-5)}


def delta_further():
    (k, _), (free, _), _ = delta_robot().values()
    samples = [sample for move in delta_samples() for sample in move]
    torques = [max(abs(torque + stiffness * (angle - free)) for _, angle, torque in samples) for stiffness in (0.0, k)]
    return {"It is ": 0.5 * sum(weight * torque ** 2 for weight, _, torque in samples), "The largest torque falls from ": torques[0],
            f"The largest torque falls from {torques[0]:.1f} to ": torques[1]}


def ball_screw_axis():
    """With p = lead/(2 pi) the torque is (m p + J/p) a + m g p. The acceleration of a move from rest to rest has the mean zero; its square has the
    integral A = 120/7 d^2/T^3 for a quintic. So p^4 = (J/m)^2 A/(A + g^2 T)."""
    A = 120.0 / 7.0 * 0.4 ** 2 / 0.5 ** 3
    return {"lead": (2.0 * pi * sqrt(1e-3 / 50.0) * (A / (A + G ** 2 * 0.5)) ** 0.25, 1e-4)}


DOOR_INERTIA, DOOR_START, DOOR_SPEED = 1.36 + 20.0 * 0.45 ** 2, 1.5, 1.0


def door_peak(z):
    return DOOR_START * exp(-z * acosh(z) / sqrt(z * z - 1.0))


def door_damping():
    return least(lambda z: door_peak(z) * (1.0 + 4.0 * z * z) / (4.0 * z), [1.3])[0]


def door_closer():
    """Of J x'' + c x' + k x = 0 from x0 at rest, with w^2 = k/J and c = 2 z w J: the integral of x^2 is x0^2 (1 + 4 z^2)/(4 z w), and for z > 1 the
    largest speed is x0 w exp(-z acosh(z)/sqrt(z^2 - 1)). At the limit of speed, the product of both is to be least over z."""
    z = door_damping()
    w = DOOR_SPEED / door_peak(z)
    return {"stiffness": (DOOR_INERTIA * w * w, 1e-3), "damper": (2.0 * z * w * DOOR_INERTIA, 1e-3),
            "objective": (DOOR_START ** 2 * (1.0 + 4.0 * z * z) / (4.0 * z * w), 1e-5)}


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
    return {"objective": (sum(x * y[0] for x, y in zip(goal, multipliers)), 1e-5)}


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
    return {"link": (0.05 / sin(atan(1000.0 / (2.0 * 5000.0))), 1e-8)}


def quick_return_shaper():
    """The lever turns back where the crank is at a right angle to it, at sin(swing) = crank/distance; the cut takes pi + 2 swing of a turn, the return
    pi - 2 swing. Twice as long: swing = 30 degrees. The ram's stroke is 2 height tan(swing)."""
    return {"crank_length": (0.3 * sin(pi / 6.0), 1e-7), "ram_height": (0.3 / tan(pi / 6.0), 1e-7)}


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
    return {"rocker": (0.5, 1e-7), "coupler": (0.2, 1e-7)}


def straight_line_error():
    """The largest height of the coupler's middle over the line [mm], from the middle to the end, of the crossed linkage 0.4, 0.5, 0.2, 0.5 m."""
    largest = 0.0
    for k in range(101):
        angle = acos(0.6) - k / 100.0 * (acos(0.6) - atan(0.75))
        tip = 0.5 * cos(angle), 0.5 * sin(angle)
        x, y = 0.4 - tip[0], -tip[1]
        length = hypot(x, y)
        along = (0.2 ** 2 - 0.5 ** 2 + length ** 2) / (2.0 * length)
        across = sqrt(0.2 ** 2 - along ** 2)
        largest = max(largest, tip[1] + 0.5 * (along * y - across * x) / length - 0.4)
    return 1e3 * largest


def sticking_drawer():
    """The couple P e is carried by 2 P e/guide at the ends of the guides, on which m g rests: m a = P - mu (2 P e/guide + m g)."""
    m, pull, offset, mu, acceleration = 5.0, 30.0, 0.2, 0.2, 1.0
    return {"guide": (2.0 * mu * pull * offset / (pull - m * acceleration - mu * m * G), 1e-3)}


def cam_drive():
    """The force on the cam is m y'' + k (y - free) + m g with y = e cos(w t): constant for k = m w^2, and then m g - k free."""
    stiffness = 0.5 * (10.0 * pi) ** 2
    return {"stiffness": (stiffness, 1e-5), "free_position": (-(20.0 - 0.5 * G) / stiffness, 1e-5)}


def knocking_pin():
    """The work of the weight m g (c + delta) is in the bearing where the blow P = k delta^1.5 is greatest: k delta^2.5/2.5."""
    weight, stiffness, blow = 20.0 * G, 1e9, 2000.0
    depth = (blow / stiffness) ** (2.0 / 3.0)
    return {"clearance": (blow * depth / (2.5 * weight) - depth, 1e-5)}


# Further numbers of the pages: the text before each, and its value.
def flexible_loop(p, d, notch):
    """L(jw) as a function of w [rad/s]."""
    def loop(w):
        s, turn = 1j * w, 2.0 * pi * 20.1317
        arm = 3.0 * s + 12000.0
        plant = arm / ((3.0 * s * s + 20.0 * s + arm) * (s * s + arm) - arm * arm)
        shape = (s * s + turn * turn) / (s * s + turn * s + turn * turn) if notch else 1.0
        return (p + d * s / (0.002 * s + 1.0)) * shape / (0.002 * s + 1.0) * plant
    return loop


def flexible_margins(p, d, notch):
    """The largest sensitivity and the smallest phase margin [rad] of the flexible axis, on a grid of frequencies, then by sections."""
    loop, grid = flexible_loop(p, d, notch), [0.5 * 1.004 ** k for k in range(1800)]
    sizes, gaps = [abs(loop(w)) for w in grid], [abs(1.0 + loop(w)) for w in grid]
    phase, gap = pi, min(gaps)
    for k in range(1, len(grid) - 1):
        low, high = grid[k - 1], grid[k + 1]
        if gaps[k] <= gaps[k - 1] and gaps[k] <= gaps[k + 1]:
            for _ in range(80):
                left, right = high - 0.6180339887498949 * (high - low), low + 0.6180339887498949 * (high - low)
                low, high = (low, right) if abs(1.0 + loop(left)) < abs(1.0 + loop(right)) else (left, high)
            gap = min(gap, abs(1.0 + loop(low)))
        low, high = grid[k], grid[k + 1]
        if (sizes[k] < 1.0) != (sizes[k + 1] < 1.0):
            for _ in range(60):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if (abs(loop(middle)) < 1.0) == (sizes[k] < 1.0) else (low, middle)
            value = -loop(low)
            phase = min(phase, abs(atan2(value.imag, value.real)))
    return 1.0 / gap, phase


def flexible_gains(start, notch=True):
    """The gains at which both bounds hold with equality, by Newton's method with differences."""
    x = list(start)
    for _ in range(8):
        def missing(*gains_now):
            largest, phase = flexible_margins(*gains_now, notch)
            return largest - 1.5, phase - 0.9
        now = missing(*x)
        columns = [[(a - b) / (1e-5 * x[i]) for a, b in zip(missing(*(value * (1.0 + 1e-5 * (k == i)) for k, value in enumerate(x))), now)] for i in range(2)]
        x = [value - step for value, (step,) in zip(x, solve(transposed(columns), [[value] for value in now]))]
    return x


def flexible_axis():
    """Both bounds are active: two equations for two gains."""
    p, d = flexible_gains([1400.0, 90.0])
    return {"p": (p, 1e-6), "d": (d, 1e-6)}


FURTHER = {
    "delta_robot": delta_further,
    "door_closer": lambda: {"is least at $\\zeta = ": door_damping()},
    "flexible_axis": lambda: {"the same bounds leave p = ": flexible_gains([200.0, 8.0], notch=False)[0]},
    "hoist_gear": lambda: {"without losses alone, the gear is ": hoist_gear(1.0)["gear"][0]},
    "goods_lift": lambda: {"A ride of 1.5 s heats the motor ": lift_heat(1.5) / goods_lift()["objective"][0]},
    "quarter_car": lambda: {"the best damper is ": quarter_car_on_a_step()},
    "scara": lambda: {"with 1 ms and 0.5 ms the best `Kp` is ": least(lambda p, i, d: scara_cost(p, i, d, 1e-3, 5e-4), [4000.0, 10000.0, 100.0])[0]},
    "straight_line_four_bar": lambda: {"and leaves it by ": straight_line_error()},
}
