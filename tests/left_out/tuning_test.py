"""Tests that a library has no influence on the weights with which it is judged."""
import json
import unittest

import tuning


def rows(clean):
    """Returns rows from {library: {method: clean}}; everything else is equal."""
    lines = []
    for library, by_method in clean.items():
        for method in [*tuning.GRID, tuning.YARDSTICK]:
            lines.append(json.dumps({**dict.fromkeys(tuning.METRICS, 1), "status": "ok", "library": library, "method": method,
                                     "clean_share": by_method.get(method, 0), "join_slide_cmps": 2}))
        lines.append(json.dumps({"status": "skipped", "library": library, "method": tuning.YARDSTICK}))
    return tuning.Rows(lines)


class LeftOut(unittest.TestCase):
    first, second, third = list(tuning.GRID)[:3]

    def test_the_others_choose(self):
        found = rows({"a": {self.first: 1, self.second: 0.5}, "b": {self.second: 1}, "c": {self.second: 0.9}})
        self.assertEqual(tuning.chosen_without(found, "a"), self.second)
        self.assertEqual(tuning.chosen_without(found, "b"), self.second)

    def test_the_judged_library_has_no_say(self):
        others = {"b": {self.third: 0.6}, "c": {self.third: 0.2, self.first: 0.5}}
        for own in ({}, {self.first: 1}, {self.second: 1}, {self.third: 1}):
            self.assertEqual(tuning.chosen_without(rows({"a": own, **others}), "a"), self.third)

    def test_a_tuner_that_looked_would_be_seen(self):
        found = rows({"a": {self.first: 1}, "b": {self.second: 0.3}, "c": {self.second: 0.3}})
        looked = max(tuning.GRID, key=lambda m: sum(found.mean(one, m, "clean_share") for one in found.libraries))
        self.assertNotEqual(looked, tuning.chosen_without(found, "a"), "the control must differ")

    def test_it_is_judged_on_other_requests(self):
        tuned = rows({"a": {}, "b": {self.second: 1}})
        judged = rows({"a": {self.second: 0.25}, "b": {self.first: 0.75}})
        table = {line["library"]: line for line in tuning.judge(tuned, judged)}
        self.assertEqual(table["a"]["clean_share"], 0.25)
        self.assertEqual(table["b"]["clean_share"], 0.75, "of equal ones the first")
        self.assertEqual(table["a"]["requests"], 1, "skipped requests are none")
        self.assertIn("mean", tuning.printed(list(table.values())))
        figures = tuning.kept(list(table.values()), 100)["figures"]
        self.assertEqual(figures["left-out/library=mean/played/clean_share, mean, times 100"], 50)
        self.assertEqual(figures["left-out/library=a/unbroken/join_slide_cmps, mean"], 2)

    def test_one_library_is_not_enough(self):
        with self.assertRaises(ValueError):
            tuning.chosen_without(rows({"a": {}}), "a")


if __name__ == "__main__":
    unittest.main()
