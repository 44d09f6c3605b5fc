"""Tests a suite as a job array of a private Slurm: whatever happens to its tasks, the merged run has the same bytes.
ETUDE_SHARDS is the number of tasks of the first test's array."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from etude_case import ik_scenario  # noqa: E402

ETUDE = os.environ["ETUDE"]
SCRIPTS = pathlib.Path("scripts").resolve()
SUITE = "scenarios/quick/ik.yaml"
SHARDS = 4
CPUS = min(2, len(os.sched_getaffinity(0)))

FEW_WORLDS = ik_scenario(trials=12)


def run(*command, **options):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=120, **options)


def must(*command):
    result = run(*command)
    assert result.returncode == 0, f"{command}: {result.stderr}"
    return result.stdout


class Cluster(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.addCleanup(self.cancel_all)
        self.folder = pathlib.Path(scratch.name)
        self.out = self.folder / "merged"
        self.shards = self.folder / "merged.shards"

    def cancel_all(self):
        run("scancel", "--user", os.getuid())
        self.wait_for_the_queue()

    def submit(self, *arguments, shards=SHARDS, cpus=1):
        """Submits the array and its merge; returns the array's job id."""
        command = SCRIPTS / "cluster/submit", "-n", shards, "-c", cpus, "-o", self.out, *arguments
        return must(*command).split()[1]

    def wait_until(self, what, condition):
        deadline = time.monotonic() + 120
        while not condition():
            self.assertLess(time.monotonic(), deadline, f"{what}: not within 120 s")
            time.sleep(0.02)

    def wait_for_the_queue(self):
        self.wait_until("an empty queue", lambda: not must("squeue", "--noheader"))

    def journal(self, shard):
        path = self.shards / str(shard) / "journal.jsonl"
        return path.read_bytes() if path.exists() else b""

    def wait_for_rows_of(self, shard):
        self.wait_until("rows", lambda: self.journal(shard).count(b"\n") > 10)

    def log(self, name):
        return (self.shards / "log" / f"{name}.log").read_text()

    def in_one_piece(self, *arguments):
        out = self.folder / "one-piece"
        must(ETUDE, "run", *arguments, "-o", out)
        return out

    def assert_same_results(self, one, other):
        result = run(SCRIPTS / "same-results", one, other)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_an_array_has_the_bytes_of_a_run_in_one_piece(self):
        shards = int(os.environ.get("ETUDE_SHARDS", SHARDS))
        suite = self.folder / "few.yaml"
        suite.write_text(FEW_WORLDS)
        self.submit(suite, shards=shards, cpus=CPUS)
        self.wait_for_the_queue()
        self.assertTrue(self.out.exists(), self.log("merge"))
        self.assert_same_results(self.in_one_piece(suite), self.out)
        jobs = [json.loads((self.shards / str(i) / "host.json").read_text())["jobs"] for i in range(1, shards + 1)]
        self.assertEqual(jobs, [CPUS] * shards)
        # The control: another seed gives other bytes.
        must(ETUDE, "run", suite, "--seed", 2, "-o", self.folder / "other")
        self.assertNotEqual(run(SCRIPTS / "same-results", self.folder / "other", self.out).returncode, 0)

    def test_a_preempted_task_continues_and_the_merge_waits_for_it(self):
        array = self.submit(SUITE)
        self.wait_for_rows_of(2)
        must("scontrol", "requeue", f"{array}_2")
        self.wait_for_the_queue()
        self.assertIn("REQUEUE", self.log(2))  # so it was stopped in the middle
        self.assertTrue(self.out.exists(), self.log("merge"))
        self.assert_same_results(self.in_one_piece(SUITE), self.out)

    def test_after_a_kill_merging_names_the_shard_and_the_same_command_finishes_it(self):
        array = self.submit(SUITE)
        self.wait_for_rows_of(2)
        must("scancel", "--full", "--signal=KILL", f"{array}_2")
        must("scancel", f"{array}_4")  # a shard that never began, or had just begun
        self.wait_for_the_queue()
        self.assertFalse(self.out.exists())
        refused = run(SCRIPTS / "cluster/merge.sbatch", ETUDE, SHARDS, self.out)
        self.assertEqual(refused.returncode, 2)
        for shard in (1, 2, 3, 4):
            self.assertEqual(f"merged.shards/{shard}" in refused.stderr, shard in (2, 4), refused.stderr)
        self.assertFalse(self.out.exists())
        kept = self.journal(2)[:self.journal(2).rfind(b"\n") + 1]

        self.submit(SUITE)
        self.wait_for_the_queue()
        self.assertTrue(self.out.exists(), self.log("merge"))
        self.assertTrue(self.journal(2).startswith(kept), "it began anew")
        self.assert_same_results(self.in_one_piece(SUITE), self.out)

    def test_shards_of_another_seed_are_not_merged_instead(self):
        suite = self.folder / "few.yaml"
        suite.write_text(FEW_WORLDS)
        self.submit(suite)
        self.wait_for_the_queue()
        shutil.rmtree(self.out)
        self.submit(suite, "--seed", 2)
        self.wait_for_the_queue()
        self.assertIn("belongs to another run: seed was 1 and is 2", self.log(1))
        self.assertFalse(self.out.exists())

    def test_bad_arguments_are_one_message_and_submit_nothing(self):
        for arguments, complaint in {
            (): "-n SHARDS is missing",
            ("-n", "0", SUITE): "'0' is not a number of shards",
            ("-n", "4", "-c", "two", SUITE): "'two' is not a number of CPUs",
            ("-n", "4"): "no scenario",
            ("-n", "4", "nowhere.yaml"): "no scenario 'nowhere.yaml'",
            ("-n", "4", "quic"): "no scenario 'quic'",
            ("-n", "4", "quick/i"): "no scenario 'quick/i'",
            ("-n", "4", "quick", "full/ik_weights", "--jobs", "2"): "--jobs: the job array sets this option itself",
            ("-n", "4", "--seed", "2", SUITE): "options of the run come after SCENARIO",
            ("-n", "4", SUITE, "--jobs", "2"): "--jobs: the job array sets this option itself",
            ("-n", "4", "-o", str(SCRIPTS), SUITE): "exists already",
        }.items():
            result = run(SCRIPTS / "cluster/submit", *arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(complaint, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1)
        self.assertEqual(must("squeue", "--noheader"), "")


def main():
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    missing = [program for program in ("munged", "slurmctld", "slurmd", "sbatch") if not shutil.which(program)]
    if missing:
        print(f"skipped: no {', '.join(missing)} here; scripts/setup --cluster installs Slurm")
        return 77
    # However this test ends, it must stop its Slurm.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    folder = tempfile.mkdtemp(prefix="slurm-", dir="/tmp")  # sockets need short paths
    try:
        must(SCRIPTS / "cluster/one-machine", "start", folder)
        os.environ["SLURM_CONF"] = f"{folder}/slurm.conf"
        return 0 if unittest.main(verbosity=2, exit=False).result.wasSuccessful() else 1
    finally:
        run(SCRIPTS / "cluster/one-machine", "stop", folder)
        shutil.rmtree(folder)


if __name__ == "__main__":
    sys.exit(main())
