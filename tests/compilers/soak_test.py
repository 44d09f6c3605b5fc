"""Tests the comparison of scripts/soak compilers: it finds equal results, and the first difference."""
import json
import tempfile
import unittest
from pathlib import Path

import soak


def line(scenario="a", error=0.5, world="01", solver="02"):
    return json.dumps({"scenario": scenario, "error_cm": error, "digest_world": world, "digest_solver": solver})


class Comparison(unittest.TestCase):
    def test_it_names_the_first_stage_that_differs(self):
        self.assertIsNone(soak.first_difference(line(), line()))
        self.assertEqual(soak.first_difference(line(), line(solver="03", error=0.6)), "solver")
        self.assertEqual(soak.first_difference(line(), line(world="00", solver="03")), "world")
        self.assertEqual(soak.first_difference(line(), line(error=0.6)), "error_cm")

    def test_it_counts_by_scenario_and_misses_nothing(self):
        rows = {"a": [line(), line(), line()], "b": [line("b")]}
        table = soak.compare(rows, {"a": [line(), line(solver="9"), line(world="9")]})
        self.assertEqual(table["a"], {"rows": 3, "same": 1, "first": {"solver": 1, "world": 1}})
        self.assertEqual(table["b"], {"rows": 1, "same": 0, "first": {"missing": 1}})
        self.assertEqual(soak.compare(rows, rows)["a"], {"rows": 3, "same": 3, "first": {}})

    def test_programs_that_are_built_are_compared_and_the_figure_is_kept(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for program, value in (("one", 1), ("two", 2)):
                (folder / program).write_text(
                    "#!/bin/sh\nwhile [ $# -gt 1 ]; do [ $1 = -o ] && mkdir -p $2 && echo "
                    f"'{line(error=value)}' >$2/cells.jsonl; shift; done\n")
                (folder / program).chmod(0o755)
            soak.run(soak.arguments(["--program", f"gcc -O2={folder}/one", f"other={folder}/two"]), kept_in=folder)
            figure = json.loads((folder / "figure.json").read_text())
            self.assertEqual(figure, {"other": {"a": {"rows": 1, "same": 0, "first": {"error_cm": 1}}}})
            with self.assertRaisesRegex(SystemExit, "nothing to compare with"):
                soak.run(soak.arguments(["--program", f"other={folder}/two"]), kept_in=folder)


if __name__ == "__main__":
    unittest.main()
