"""A metric in Python: the jump at a transition, as `jump_cm` measures it (docs/reference/metrics.md)."""
import math

import etude

REACH = 5  # frames on either side of a transition point


def largest_second_difference(poses, frame):
    before, here, after = poses[frame - 1:frame + 2]
    differences = [c - 2 * b + a for a, b, c in zip(before, here, after)]
    return max(math.sqrt(x * x + y * y + z * z)
               for x, y, z in zip(differences[0::3], differences[1::3], differences[2::3]))


@etude.metric("jump", unit="cm")
def jump(cell):
    poses = cell.track("coach").poses
    worst = 0.0
    for point in cell.extras["transition_frames"]:
        for frame in range(max(point - REACH, 1), min(point + REACH, len(poses) - 2) + 1):
            worst = max(worst, 100 * largest_second_difference(poses, frame))
    return worst


if __name__ == "__main__":
    etude.serve(jump)
