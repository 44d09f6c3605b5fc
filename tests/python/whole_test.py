"""Tests that take longer: a wheel in a clean environment, columns of many cells, every task's array shapes, the
notebook."""
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from python_case import CACHE, ETUDE, ROOT, SCENARIO, PythonCase

import etude
from etude import conversation

# Reports on standard error whether a line survives conversion to the dataclasses and back; its answers do not matter.
MIRROR = """import json, sys
from etude import conversation
spec = conversation.Spec(sys.argv[1], sys.argv[2].strip("-"), "mirror", "1", {}, None, [], False)
setting, asked, _, begin = conversation._class_names(spec)
known = {"setting": setting, "problem": asked, "step": asked, "begin": begin}
for line in sys.stdin:
    told = json.loads(line)
    kind = told["type"]
    if kind in known:
        back = known[kind].of(told[kind]).to_json()
        whole = {key: value for key, value in told[kind].items() if value is not None and key != "of_a_later_version"}
        same = {key: back.get(key) for key in whole} == whole
        print("same" if same else f"LOST of {kind}: {set(whole) - set(back)}", file=sys.stderr)
    if kind == "hello":
        reply = {"type": "hello", "protocol": 1, "name": "mirror", "version": "1"}
    elif kind in ("setting", "begin"):
        reply = {"type": "ready"}
    else:
        reply = {**{key: told[key] for key in ("id", "number") if key in told}, "type": "no_answer", "reason": "mirror"}
    print(json.dumps(reply), flush=True)
"""


class Whole(PythonCase):
    def test_every_task_s_settings_and_problems_are_wholly_known(self):
        mirror = self.folder / "mirror.py"
        mirror.write_text(MIRROR)
        for task, seats in conversation.TASKS.items():
            for seat in seats:
                told = subprocess.run([ETUDE, "check-method", "--no-fence", "--task", task,
                                       *["--seat", seat] * bool(seat), "--", sys.executable, mirror, task, seat or "-"], capture_output=True, text=True)
                lines = told.stderr.splitlines()
                self.assertIn("same", lines, (task, seat, told.stdout))
                self.assertEqual([line for line in lines if "LOST" in line], [], (task, seat))

    def test_columns_of_many_cells_are_those_of_the_rows(self):
        scenario = {**SCENARIO, "trials": 25010, "video": {}, "methods": [
            {"name": "a", "solver": "gauss-newton"}, {"name": "b", "solver": "damped-least-squares"}]}
        run = etude.run(scenario, output=self.folder / "run", progress=False)
        self.assertTrue((run.folder / "columns").is_dir())
        table = run["ik"]
        rows = [json.loads(line) for line in subprocess.run([ETUDE, "rows", run.folder], capture_output=True, text=True,
                                                            check=True).stdout.splitlines()]
        self.assertEqual(len(table), 100040)
        for name in table.columns:
            theirs = [row[name] for row in rows]  # the lists are too long for a line-by-line message
            differing = [i for i, (a, b) in enumerate(zip(table[name], theirs)) if a != b or type(a) is not type(b)]
            self.assertEqual([(name, i, table[name][i], theirs[i]) for i in differing[:3]], [])
        self.assertEqual([f"{digest:016x}" for digest in table["digest_solution"][:50]],
                         [row["digest_solution"] for row in rows[:50]])
        pairs = run.pairs("b", "a", "position_error_cm", condition="joint_noise_deg=15")
        self.assertEqual(len(pairs), 25010)
        curve = next(run.series("position_error_max_cm", method="b", condition="joint_noise_deg=15", trial=7))
        self.assertAlmostEqual(curve.values[-1], next(row["position_error_max_cm"] for row in rows
                                                      if row["cell"] == curve.cell), places=9)

    @unittest.skipUnless(importlib.util.find_spec("build"), "needs python3-build (scripts/setup --tests)")
    def test_a_wheel_is_built_and_installed_without_a_network(self):
        source = self.folder / "source"
        shutil.copytree(ROOT / "python", source, ignore=shutil.ignore_patterns("__pycache__"))
        subprocess.run([sys.executable, "-m", "build", "--no-isolation", "--wheel", "-o", self.folder, source],
                       check=True, capture_output=True, cwd=self.folder)
        wheel, = self.folder.glob("*.whl")
        self.assertTrue(wheel.name.endswith("-py3-none-any.whl"), wheel)
        clean = self.folder / "clean"
        subprocess.run([sys.executable, "-m", "venv", clean], check=True, capture_output=True)
        environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        subprocess.run([clean / "bin/pip", "install", "--no-index", wheel], check=True, capture_output=True,
                       env=environment)
        script = self.folder / "script.py"
        script.write_text(
            "import etude, sys\n"
            "assert etude.__file__.startswith(sys.prefix), etude.__file__\n"
            "@etude.method(task='ik')\n"
            "def mine(problem):\n"
            "    return problem.start_angles_deg\n"
            f"run = etude.run({ {**SCENARIO, 'trials': 1, 'video': {}}!r}, methods=[mine], output='run', progress=False)\n"
            "assert run['ik'].where(method='mine')['status'][0] == 'unsolved'\n"
            "print(run['ik']['orientation_error_deg'].unit)\n")
        told = subprocess.run([clean / "bin/python", script], capture_output=True, text=True, cwd=self.folder,
                              env=environment)
        self.assertEqual((told.stdout, told.returncode), ("deg\n", 0), told.stderr)

    def test_installed_it_is_found_by_python_and_by_programs_in_the_fence(self):
        prefix = self.folder / "prefix"
        subprocess.run(["cmake", "--install", pathlib.Path(ETUDE).resolve().parent, "--prefix", prefix], check=True,
                       capture_output=True)
        (self.folder / "mine.py").write_text("import etude\n"
                                             "assert '/prefix/share/etude/python/' in etude.__file__, etude.__file__\n"
                                             "@etude.method(task='ik')\n"
                                             "def mine(problem):\n"
                                             "    return problem.start_angles_deg\n"
                                             "etude.serve(mine)\n")
        code = ("import site, sys; site.addsitedir(sys.argv[1]); import etude\n"
                "print(etude.find_program())\n"
                f"run = etude.run({ {**SCENARIO, 'trials': 1, 'video': {}}!r}, output='run', progress=False,\n"
                "                methods=[{'name': 'mine', 'exec': ['/usr/bin/python3', 'mine.py']}])\n"
                "print(*run['ik'].where(method='mine')['status'])\n")
        environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "ETUDE")}
        told = subprocess.run([sys.executable, "-c", code, prefix / "lib/python3/dist-packages"], capture_output=True,
                              text=True, cwd=self.folder, env=environment)
        self.assertEqual(told.stdout, f"{prefix}/bin/etude\nunsolved unsolved\n", told.stderr)

    @unittest.skipUnless(all(map(importlib.util.find_spec, ("nbclient", "ipykernel", "matplotlib", "pandas"))),
                         "needs scripts/setup --python")
    def test_the_notebook_runs_and_shows_what_it_says(self):
        import nbclient
        import nbformat
        os.environ["PYTHONPATH"] = str(ROOT / "python")
        notebook = nbformat.read(ROOT / "examples/python/first_hour.ipynb", 4)
        for cell in notebook.cells:
            self.assertFalse(cell.get("outputs"), "kept without outputs")
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3",
                                resources={"metadata": {"path": str(self.folder)}}).execute()
        shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
        pictures = [output for output in shown if "image/png" in output.get("data", {})]
        self.assertGreaterEqual(len(pictures), 2)
        text = "".join(output.get("text", "") + output.get("data", {}).get("text/plain", "") for output in shown)
        self.assertIn("mine", text)
        self.assertIn("on these worlds;", text)
        self.assertIn("mine against ", text)
        kept = os.environ.get("ETUDE_NOTEBOOK")
        if kept:
            nbformat.write(notebook, kept)


if __name__ == "__main__":
    assert pathlib.Path(CACHE.name).is_dir()
    unittest.main()
