"""The axes of cameras that look at (0, 1, 0), in OpenCV's directions."""
import math


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / math.sqrt(dot(a, a)) for x in a]


def axes_of(place):
    """Returns the directions right, down and forward of a camera at this place."""
    z = unit([0 - place[0], 1 - place[1], 0 - place[2]])
    x = unit(cross(z, [0, 1, 0]))
    return [x, cross(z, x), z]
