"""Parts that the tests of motion files share."""
import csv
import json

import numpy
from etude_case import EtudeCase


class MotionFileCase(EtudeCase):
    def joints(self, path, *options):
        """Returns a clip's twenty joints by frame, as `etude clip convert` writes them."""
        out = self.folder / "joints.csv"
        self.ends(0, "clip", "convert", path, out, "--overwrite", *options)
        with open(out) as file:
            rows = list(csv.DictReader(file))
        names = [name[:-4] for name in rows[0] if name.endswith("_x_m")]
        return [{name: numpy.array([float(row[f"{name}_{axis}_m"]) for axis in "xyz"]) for name in names} for row in rows]

    def info(self, path):
        return json.loads(self.ends(0, "clip", "info", path, "--json").stdout)

    def refused(self, path, complaint):
        self.refusal("clip", "info", path, says=complaint)

    def scenario(self):
        return self.cut_scenario("builtin:sway")
