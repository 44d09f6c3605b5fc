#!/usr/bin/env python3
"""OpenCV's background subtractors as the segmenter of the task capture, with OpenCV's default settings.

Options: `subtractor`, "mog2" (Zivkovic 2004) or "knn" (Zivkovic and van der Heijden 2006); `empty_room`, true
(the default) if the subtractor sees the empty room first; `history`, the number of pictures that it remembers (500,
OpenCV's default). Both subtractors mark shadows; shadows do not count as the person.

There is one picture of the empty room. MOG2 gets it once and takes it as the background with an assumed variance; if it
got the same picture repeatedly, it would learn a variance of zero. KNN always assumes a variance; it gets the picture
for a second, which fills its samples.
"""
import os

import cv2
import etude
import numpy

SUBTRACTORS = {"mog2": cv2.createBackgroundSubtractorMOG2, "knn": cv2.createBackgroundSubtractorKNN}
HISTORY = 500
SECOND = 30  # pictures
PERSON = 255  # shadows are 127


@etude.method(task="capture", seat="segmenter", name="opencv-subtractor", version=cv2.__version__)
class Subtractor:
    def __init__(self, options):
        cv2.setNumThreads(1)
        self.options = options

    def begin(self, session, files):
        cv2.setRNGSeed(1)  # KNN draws random numbers: use the same ones for every camera
        kind, history = self.options.get("subtractor", "mog2"), self.options.get("history", HISTORY)
        self.subtractor, self.rate = SUBTRACTORS[kind](history=history), 1 / history
        if not self.options.get("empty_room", True):
            self.rate = -1  # automatic: it learns fast at first
            return
        background = cv2.imread(os.path.join(files, session.background))
        self.subtractor.apply(background, learningRate=1)
        if kind == "knn":
            for _ in range(SECOND):
                self.subtractor.apply(background)

    def step(self, seen, files):
        found = self.subtractor.apply(cv2.imread(os.path.join(files, seen.picture)), learningRate=self.rate)
        pixels = (found == PERSON).ravel(order="F")
        ends = numpy.flatnonzero(numpy.diff(pixels)) + 1
        runs = numpy.diff(ends, prepend=0, append=pixels.size).tolist()
        return {"mask": {"size": list(found.shape), "counts": [0] * int(pixels[0]) + runs}}


if __name__ == "__main__":
    etude.serve(Subtractor)
