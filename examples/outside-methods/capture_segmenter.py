#!/usr/bin/env python3
"""Finds the person in a picture: the pixels whose green differs by more than 24 levels from the empty room."""
import os
import re
from operator import sub

import etude

MOST = 24
CHANGED = bytes(abs(difference - 255) > MOST for difference in range(511))  # index 0 is the difference -255


def read_green(path):
    with open(path, "rb") as file:
        _, width, height, _, pixels = re.split(rb"\s", file.read(), maxsplit=4)
    return int(width), int(height), pixels[1::3]


@etude.method(task="capture", seat="segmenter", name="green-difference-python", version="1.0")
class GreenDifference:
    def begin(self, session, files):
        self.width, self.height, self.empty = read_green(os.path.join(files, session.background))

    def step(self, seen, files):
        _, _, green = read_green(os.path.join(files, seen.picture))
        changed = bytes(CHANGED[difference + 255] for difference in map(sub, green, self.empty))
        columns = b"".join(changed[x::self.width] for x in range(self.width))
        runs = [run.end() - run.start() for run in re.finditer(rb"\x00+|\x01+", columns)]
        return {"mask": {"size": [self.height, self.width], "counts": [0] * columns[0] + runs}}


if __name__ == "__main__":
    etude.serve(GreenDifference)
