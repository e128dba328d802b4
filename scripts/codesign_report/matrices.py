# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Matrices as lists of rows: what a linear system does over an interval with constant inputs.

The program is installed without numpy, which only the Python package needs; a page has few states and few intervals."""
import math
import operator


def product(left, right):
    """The product of two matrices, lists of rows."""
    columns = list(zip(*right))
    return [[sum(map(operator.mul, row, column)) for column in columns] for row in left]


def exponential(matrix):
    """exp(matrix) by scaling, the Taylor series to the 18th power, and squaring."""
    size = max(sum(map(abs, row)) for row in matrix)
    halvings = max(0, math.ceil(math.log2(size / 0.5))) if size > 0.0 else 0
    scaled = [[value / 2.0 ** halvings for value in row] for row in matrix]
    identity = [[float(i == j) for j in range(len(matrix))] for i in range(len(matrix))]
    result = identity
    for power in range(18, 0, -1):  # Horner: 1 + M/1 (1 + M/2 (1 + ...))
        result = product(scaled, [[value / power for value in row] for row in result])
        result = [[value + one for value, one in zip(row, ones)] for row, ones in zip(result, identity)]
    for _ in range(halvings):
        result = product(result, result)
    return result


def held(A, B, interval):
    """(Phi, Gamma) of x(t + interval) = Phi x(t) + Gamma u with constant inputs: the exponential of [[A, B], [0, 0]]."""
    width = len(A) + len(B[0])
    return parts(exponential([[interval * value for value in (*row, *last)] for row, last in zip(A, B)] + [[0.0] * width for _ in B[0]]), len(A))


def powered(A, B, count):
    """(Phi, Gamma) of x(k + count) = Phi x(k) + Gamma u with constant inputs: a power of [[A, B], [0, 1]] by squaring."""
    inputs = range(len(B[0]))
    factor = [[*row, *last] for row, last in zip(A, B)] + [[0.0] * len(A) + [float(i == j) for j in inputs] for i in inputs]
    whole = None
    while count:
        if count % 2:
            whole = factor if whole is None else product(whole, factor)
        count //= 2
        factor = product(factor, factor) if count else factor
    return parts(whole, len(A))


def parts(whole, size):
    return [row[:size] for row in whole[:size]], [row[size:] for row in whole[:size]]
