#!/usr/bin/env python3
"""Looks at every frame of the library, in time order."""
import array
import heapq
import os

import etude


@etude.method(task="search", name="search-loop-python", version="1.0")
class Loop:
    def __init__(self, setting, files):
        numbers = array.array("d")
        with open(os.path.join(files, setting.file), "rb") as file:
            numbers.frombytes(file.read())
        self.setting = setting
        self.roots = [term.weight ** 0.5 for term in setting.terms]
        width = len(self.roots)
        self.library = [numbers[i:i + width] for i in range(0, len(numbers), width)]

    def answer(self, problem):
        return {"found": [find(self.setting, self.roots, self.library, query) for query in problem.queries]}


def find(setting, roots, library, query):
    distances = [sum((root * (a - b)) ** 2 for root, a, b in zip(roots, frame, query)) ** 0.5 for frame in library]
    if setting.query in ("nearest", "nearest-10"):
        count = 1 if setting.query == "nearest" else 10
        return heapq.nsmallest(count, range(len(library)), key=lambda frame: (distances[frame], frame))
    close = [frame for frame, distance in enumerate(distances) if distance < setting.threshold]
    return close[:1] if setting.query == "first" else close


if __name__ == "__main__":
    etude.serve(Loop)
