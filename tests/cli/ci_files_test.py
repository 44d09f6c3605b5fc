"""Runs the steps of the files of ci/ in the repository of examples/ci-repository, with the variables that servers
set."""
import os
import pathlib
import re
import shutil
import subprocess
import unittest

import yaml
from etude_case import ETUDE, EtudeCase, heavy

ROOT = pathlib.Path(__file__).parents[2]
CI = ROOT / "ci"
EXAMPLE = ROOT / "examples" / "ci-repository"


def fill_in(text, known):
    """Replaces a server's ${{ … }}; each must be known."""
    return re.sub(r"\$\{\{ *(.*?) *\}\}", lambda match: known[match[1]], str(text))


def holds(condition, known):
    """Evaluates a step's condition in the few forms that ours have. After a failed step, only steps with always()
    run."""
    words = condition.replace("&&", " and ").replace("always()", "True")
    return eval(re.sub(r"\b(?:inputs|github)\.\w+", lambda match: repr(known[match[0]]), words), {})  # noqa: S307: our own files


def containerfile(text):
    """Returns the instructions of a container file: (name, words)."""
    lines = re.sub(r"\\\n", " ", re.sub(r"^#.*\n", "", text, flags=re.M)).splitlines()
    found = [line.split(None, 1) for line in lines if line.strip()]
    for instruction in found:
        if len(instruction) != 2 or instruction[0] not in ("FROM", "COPY", "RUN", "CMD"):
            raise ValueError(f"no instruction: {' '.join(instruction)}")
        if instruction[0] == "RUN":
            subprocess.run(["sh", "-n", "-c", instruction[1]], check=True, stderr=subprocess.DEVNULL)
    if [name for name, _ in found].index("FROM") != 0:
        raise ValueError("FROM must be first")
    return found


class CiFiles(EtudeCase):
    def setUp(self):
        super().setUp()
        self.repository, self.prefix = self.folder / "repository", self.folder / "prefix"
        shutil.copytree(EXAMPLE, self.repository)
        for folder in "bin", "share/etude":
            (self.prefix / folder).mkdir(parents=True)
        (self.prefix / "bin" / "etude").symlink_to(ETUDE)
        (self.prefix / "share" / "etude" / "ci").symlink_to(CI)
        for program in "gh", "curl":   # log what the servers are sent
            (self.prefix / "bin" / program).write_text(f'#!/bin/sh\necho "$@" >> {self.folder}/{program}\n')
            (self.prefix / "bin" / program).chmod(0o755)
        self.environment = {"PATH": f"{self.prefix}/bin:/usr/bin:/bin", "HOME": str(self.folder), "CI": "true"}

    def bash(self, script, variables):
        return subprocess.run(["bash", "-eo", "pipefail", "-c", script], cwd=self.repository, capture_output=True, text=True,
                              env={**self.environment, **variables}, timeout=120)

    def run_action(self, **changed):
        """Runs the steps of ci/action.yml as GitHub does: returns (the failed step or None, the job's summary,
        outputs)."""
        action = yaml.safe_load((CI / "action.yml").read_text())
        workflow = yaml.safe_load((self.repository / ".github/workflows/etude.yml").read_text())
        call = next(step for step in workflow["jobs"]["gate"]["steps"] if "/ci@" in step.get("uses", ""))
        given = {**call["with"], **changed}
        self.assertLessEqual(set(given), set(action["inputs"]))
        known = {f"inputs.{name}": given.get(name, one.get("default")) for name, one in action["inputs"].items()}
        self.assertNotIn(None, known.values(), "a required input is missing")
        known |= {"runner.os": "Linux", "runner.arch": "X64", "github.token": "secret", "github.event.number": "7",
                  "github.event_name": "pull_request"}
        files = {name: self.folder / name for name in ("GITHUB_STEP_SUMMARY", "GITHUB_OUTPUT", "GITHUB_PATH")}
        for path in files.values():
            path.write_text("")
        failed, ran = None, 0
        for step in action["runs"]["steps"]:
            condition = step.get("if", "True")
            if (failed and "always()" not in condition) or not holds(condition, known):
                continue
            ran += 1
            if "uses" in step:
                self.assertRegex(step["uses"], r"^actions/(cache|upload-artifact)@v4$")
                for value in step["with"].values():
                    fill_in(value, known)
                continue
            variables = {name: fill_in(value, known) for name, value in step.get("env", {}).items()}
            result = self.bash(step["run"], {**variables, **{name: str(path) for name, path in files.items()},
                                             "GITHUB_ACTION_PATH": str(CI), "GITHUB_REPOSITORY": "ann/solver"})
            if result.returncode != 0:
                failed = step["name"]
            for line in files["GITHUB_OUTPUT"].read_text().splitlines():
                name, value = line.split("=", 1)
                known[f"steps.{step.get('id')}.outputs.{name}"] = value
            files["GITHUB_OUTPUT"].write_text("")
        self.assertEqual(ran, 6)
        return failed, files["GITHUB_STEP_SUMMARY"].read_text(), known["steps.gate.outputs.verdict"]

    @heavy
    def test_the_example_passes_on_github_and_a_worse_solver_does_not(self):
        failed, summary, verdict = self.run_action()
        self.assertEqual((failed, verdict), (None, "pass"), summary)
        self.assertIn("Etude gate of ik: pass", summary)
        self.assertIn("84 same", summary)
        self.assertIn("pr comment 7 --repo ann/solver --body-file out/etude/report/gate.md", (self.folder / "gh").read_text())
        for name in "gate.xml", "index.html":
            self.assertTrue((self.repository / "out/etude/report" / name).exists(), name)

        solver = self.repository / "solver.py"
        solver.write_text(solver.read_text().replace("DAMPING = 1e-3", "DAMPING = 1.0"))
        failed, summary, verdict = self.run_action()
        self.assertEqual((failed, verdict), ("Run the suite and compare it with the baseline", "regression"))
        self.assertRegex(summary, r"\*\*worse\*\* \| ik-weights \| joint\\_noise\\_deg=5 \| ours \| effector position error \|")
        self.assertIn("72 same", summary)  # the other clips are unchanged

        # A solver that does not start leaves nothing of the earlier verdicts.
        solver.write_text("raise SystemExit(3)\n")
        failed, summary, verdict = self.run_action()
        self.assertNotEqual(verdict, "regression")
        self.assertIn(f"## Etude gate: {verdict}", summary)
        self.assertFalse((self.repository / "out/etude/report/gate.xml").exists())

    @heavy
    def test_what_is_missing_is_told_in_the_summary(self):
        summary, right = self.folder / "summary", {"SUITE": "quick/ik", "METHOD": "{name: ours, exec: [python3, solver.py]}",
                                                   "BASELINE": "no.json", "ARGUMENTS": "--trials 1"}
        for wrong, complaint in [({}, "no.json: does not exist; --update writes this baseline from the run"),
                                 ({"SUITE": "quick/ikk"}, "did you mean 'quick/ik'?"),
                                 ({"SUITE": "quick"}, "SUITE quick is not exactly one scenario"),
                                 ({"SUITE": "solver.py"}, "solver.py of this repository; write the method into this scenario"),
                                 ({"BASELINE": ""}, "SUITE and BASELINE must be set")]:
            with self.subTest(complaint):
                self.assertEqual(self.bash(str(CI / "gate"), right | wrong | {"GITHUB_STEP_SUMMARY": str(summary)}).returncode, 2)
                self.assertIn("## Etude gate: bad input", summary.read_text())
                self.assertIn(complaint, summary.read_text())
                summary.unlink()
                shutil.rmtree(self.repository / "out")

    @heavy
    def test_the_example_passes_on_gitlab(self):
        template = yaml.safe_load((CI / "gitlab-ci.yml").read_text())
        own = yaml.safe_load((self.repository / ".gitlab-ci.yml").read_text())
        job = own["etude"]
        base = template[job.pop("extends")]
        self.assertTrue(own["include"][0]["remote"].endswith("/ci/gitlab-ci.yml"))
        variables = base["variables"] | job["variables"]
        self.assertEqual(set(variables), set(base["variables"]), "a variable that the template does not know")
        variables |= {"CI_PROJECT_DIR": str(self.repository), "CI_API_V4_URL": "https://host/api/v4", "CI_PROJECT_ID": "3",
                      "CI_MERGE_REQUEST_IID": "7", "ETUDE_NOTE_TOKEN": "secret", "ETUDE_REPOSITORY": ""}
        result = self.bash("\n".join(base["before_script"] + base["script"]), variables)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Gate: pass", result.stdout)
        self.assertEqual(self.bash("\n".join(base["after_script"]), variables).returncode, 0)
        self.assertIn("body=<out/etude/report/gate.md https://host/api/v4/projects/3/merge_requests/7/notes",
                      (self.folder / "curl").read_text())
        junit = base["artifacts"]["reports"]["junit"].replace("$RUN", variables["RUN"])
        self.assertTrue((self.repository / junit).exists())

    def test_motions_are_triaged_on_gitlab(self):
        template = yaml.safe_load((CI / "gitlab-ci.yml").read_text())
        job = template[".etude-triage"]
        for folder in "motions", "my clips":
            (self.repository / folder).mkdir()
            self.ends(0, "clip", "convert", "builtin:clap", self.repository / folder / "clap.csv")
        result = self.bash("\n".join(job["script"]), job["variables"])
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        # One pattern a line; folders may have spaces in their names.
        result = self.bash("\n".join(job["script"]), job["variables"] | {"MOTIONS": "a=my clips/*.csv\nb=motions/*\n"})
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("2 of 2 clips without a fault", result.stdout)
        # The control: a clip a metre above the floor.
        lines = [line.split(",") for line in (self.repository / "motions/clap.csv").read_text().splitlines()]
        for line in lines[1:]:
            for column, name in enumerate(lines[0]):
                if name.endswith("_y_m"):
                    line[column] = str(float(line[column]) + 0.3)
        (self.repository / "motions/high.csv").write_text("\n".join(",".join(line) for line in lines) + "\n")
        summary = self.folder / "summary"
        result = self.bash("\n".join(job["script"]), job["variables"] | {"GITHUB_STEP_SUMMARY": str(summary)})
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("high: ", result.stdout)
        self.assertTrue(summary.read_text())
        junit = job["artifacts"]["reports"]["junit"].replace("$RUN", job["variables"]["RUN"])
        self.assertIn("<failure", (self.repository / junit).read_text())

    def test_a_release_gets_every_package(self):
        (self.repository / "dist").mkdir()
        for name in "etude_1_amd64.deb", "etude-1-py3-none-any.whl":
            (self.repository / "dist" / name).write_text(name)
        github = yaml.safe_load((CI / "release.yml").read_text())["jobs"]["packages"]
        attach = next(step for step in github["steps"] if "env" in step)
        result = self.bash(attach["run"], {"GITHUB_REF_NAME": "v1", "GITHUB_REPOSITORY": "ann/etude"})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("release upload v1 dist/etude-1-py3-none-any.whl dist/etude_1_amd64.deb --repo ann/etude --clobber",
                      (self.folder / "gh").read_text())
        gitlab = yaml.safe_load((CI / "gitlab-ci.yml").read_text())[".etude-packages"]
        result = self.bash(gitlab["script"][-1], {"CI_API_V4_URL": "https://host/api/v4", "CI_PROJECT_ID": "3", "CI_COMMIT_TAG": "v1",
                                                  "CI_JOB_TOKEN": "secret"})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("https://host/api/v4/projects/3/packages/generic/etude/v1/etude_1_amd64.deb", (self.folder / "curl").read_text())
        # Both files build with the same script, on every Debian listed.
        debians = [str(number) for number in github["strategy"]["matrix"]["debian"]]
        self.assertEqual(debians, gitlab["parallel"]["matrix"][0]["DEBIAN"])
        self.assertIn({"run": "ci/packages dist"}, github["steps"])
        self.assertIn("ci/packages dist", gitlab["script"])

    def test_what_brings_etude_is_written_as_shells_and_builders_read_it(self):
        for script in "gate", "install", "packages", "triage":
            subprocess.run(["bash", "-n", CI / script], check=True)
        found = containerfile((CI / "Containerfile").read_text())
        self.assertEqual([name for name, _ in found], ["FROM", "COPY", "RUN", "RUN", "CMD"])
        for wrong in "RUM true\n", "FROM\n", "FROM debian:12\nRUN (true\n", "RUN true\nFROM debian:12\n":
            with self.subTest(wrong), self.assertRaises((ValueError, subprocess.CalledProcessError)):
                containerfile(wrong)
        text = (CI / "install").read_text()
        for name in re.findall(r"--preset (\S+)", text):
            self.assertIn(f'"name": "{name}"', (ROOT / "CMakePresets.json").read_text())
        self.assertTrue((ROOT / "scripts/setup").exists())
        self.assertIn("scripts/setup", text)


if __name__ == "__main__":
    unittest.main()
