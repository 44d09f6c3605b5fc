"""Tests the mutator: what it recognises as code, what it changes, and that good tests kill mutants and bad tests do
not."""

import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import figure  # noqa: E402
import rewrite  # noqa: E402
import shadow  # noqa: E402
import sites  # noqa: E402
import soak  # noqa: E402
import tokens  # noqa: E402
from trials import Test, end_when_asleep, in_batches, judge, record, run_program  # noqa: E402


COMPILER = [os.environ.get("CXX", "c++"), "-std=c++20", "-O0", "-include", HERE / "mutant.h"]


def found_in(text):
    return [(site.original, site.mutations) for site in sites.find_sites(text)]


def originals_in(text):
    return [site.original for site in sites.find_sites(text)]


def rewritten(text):
    numbered, number = [], 1
    for site in sites.find_sites(text):
        numbered.append((site, number))
        number += len(site.mutations)
    return rewrite.rewrite(text, numbered), numbered, number - 1


def mutant_of(number, file="engine/toy/toy.cc"):
    return shadow.Mutant(number, file, 1, 1, "", "", "")


class Tokens(unittest.TestCase):
    def texts(self, code):
        return [token.text for token in tokens.tokenize(code)]

    def test_comments_directives_and_white_space_are_no_tokens(self):
        self.assertEqual(self.texts("#define X \\\n  1 + 1\na /* + */ = b; // < c\n"), ["a", "=", "b", ";"])

    def test_strings_are_one_token_whatever_they_hold(self):
        self.assertEqual(self.texts('f("a \\" < 1", R"x(1 + ")" 2)x", \'\\\'\', u8"")'),
                         ["f", "(", '"a \\" < 1"', ",", 'R"x(1 + ")" 2)x"', ",", "'\\''", ",", 'u8""', ")"])

    def test_numbers_are_one_token(self):
        for number in ("1'000'000", "1e-9", "0x1F", ".5f", "2.", "3u", "1.5e+3"):
            self.assertEqual(self.texts(f"a = {number};"), ["a", "=", number, ";"])

    def test_marks_are_the_longest_that_fit(self):
        self.assertEqual(self.texts("a<=>b<<=c->d->*e::f&&g"),
                         ["a", "<=>", "b", "<<=", "c", "->", "d", "->*", "e", "::", "f", "&&", "g"])

    def test_brackets_know_their_partners(self):
        found = tokens.tokenize("f(a[1], {2})")
        self.assertEqual([token.match for token in found], [-1, 10, -1, 5, -1, 3, -1, 9, -1, 7, 1])
        with self.assertRaises(ValueError):
            tokens.tokenize("f(a]")


class Sites(unittest.TestCase):
    def test_each_kind_is_found(self):
        self.assertEqual(found_in("bool f(int a) { return a < 2; }"), [("<", ["<=", ">="]), ("2", ["2 / 4", "2 + 1"])])
        self.assertEqual(found_in("void f() { if (a) return; }"), [("if (c)", ["if (!(c))", "if (false)"])])
        self.assertEqual(originals_in("void f() { a = b && c || d ? -x : y; }"),
                         ["a = b && c || d ? -x : y;", "&&", "||", "c ?", "-x"])
        self.assertEqual(originals_in("void f() { g(x); h += 0.5; }"), ["g(x);", "h += 0.5;", "+=", "0.5"])
        self.assertEqual(found_in("int f() { return std::max(a, b); }"), [("std::max", ["std::min"])])
        self.assertEqual(found_in("bool f() { return true; }"), [("true", ["!true"])])

    def test_a_named_constant_is_mutated_where_it_is_used(self):
        code = "constexpr double kStep = 0.5;\ndouble f(double x) { return kStep * x; }"
        self.assertEqual(found_in(code), [("kStep", ["kStep / 4"]), ("*", ["/"])])

    def test_what_does_not_run_has_no_sites(self):
        for code in ("constexpr int Two(int a) { return a + 2; }", "constexpr int kA[] = {1, 2};",
                     "static_assert(a < 3);", "std::array<int, 3> a;", "template <int kN = 4> void f();",
                     "void f() { switch (a) { case 3: break; } }", "#if A > 3\n#endif", "enum E { kA = 1, kB = 2 };",
                     "struct A { A(const A&) = delete; A(int); };", "namespace a { F(b); }",
                     "void f() { assert(a < 3); }", "using A = B<1>;", "void f(int&& a, char* b, const C& c);",
                     "bool operator<(const A& a, const A& b);"):
            self.assertEqual(originals_in(code), [], code)

    def test_a_statement_before_an_else_stays(self):
        self.assertEqual(originals_in("void f() { if (a) g(); else h(); }"), ["if (c)", "h();"])

    def test_a_condition_that_declares_is_not_negated(self):
        self.assertEqual(originals_in("void f() { if (auto a = g()) return; }"), [])
        self.assertEqual(originals_in("void f() { if (auto a = g(); a) return; }"), ["if (c)"])

    def test_a_header_has_the_defaults_of_its_members(self):
        text = "struct A {\n  double a = 0.5;\n  int b = 0;\n  bool c = true;\n  int F(int d) { return d + 1; }\n};\n"
        self.assertEqual([site.original for site in sites.find_defaults(text)], ["0.5", "true"])

    def test_lines_stay_where_they_are(self):
        text = (HERE / "toy/toy.cc").read_text()
        self.assertEqual(rewritten(text)[0].count("\n"), text.count("\n"))

    def test_without_sites_a_text_is_what_it_was(self):
        text = (HERE / "toy/toy.cc").read_text()
        self.assertEqual(rewrite.rewrite(text, []), text)


class Toy(unittest.TestCase):
    """A small program with its mutants, compiled once."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        work = Path(cls.folder.name)
        text, cls.numbered, cls.count = rewritten((HERE / "toy/toy.cc").read_text())
        (work / "toy.cc").write_text(text)
        compiler = [*COMPILER, "-I", HERE / "toy"]
        subprocess.run([*compiler, "-c", work / "toy.cc", "-o", work / "toy.o"], check=True)
        for name in ("good_test", "bad_test"):
            subprocess.run([*compiler, work / "toy.o", HERE / f"toy/{name}.cc", "-o", work / name], check=True)
        cls.work = work

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def verdicts(self, name):
        test = record(Test("engine/toy", (str(self.work / name),), "all"), self.work)
        return test, [judge(mutant_of(n), [test], self.work) for n in range(1, self.count + 1)]

    def test_a_good_test_kills_all_mutants(self):
        self.assertGreater(self.count, 30)
        _, verdicts = self.verdicts("good_test")
        alive = [site.original for (site, first) in self.numbered
                 for k in range(len(site.mutations)) if verdicts[first + k - 1] != "killed"]
        self.assertEqual(alive, [])

    def test_a_bad_test_reaches_all_and_kills_none(self):
        test, verdicts = self.verdicts("bad_test")
        self.assertEqual(test.reached, set(range(1, self.count + 1)))
        self.assertEqual(set(verdicts), {"survived"})

    def test_a_mutant_that_no_test_reaches_or_only_another_folders_is_unreached(self):
        test, _ = self.verdicts("bad_test")
        for mutant in (mutant_of(1, "engine/other/a.cc"), mutant_of(60000)):
            self.assertEqual(judge(mutant, [test], self.work), "unreached")

    def test_a_folder_without_tests_has_those_of_the_one_above(self):
        test, _ = self.verdicts("good_test")
        self.assertEqual(judge(mutant_of(1, "engine/toy/inner/a.cc"), [test], self.work), "killed")

    def test_a_program_that_does_not_end_is_too_slow(self):
        test = Test("engine/toy", ("sh", "-c", "while :; do :; done"), "all", 0.0, frozenset([1]))
        self.assertEqual(judge(mutant_of(1), [test], self.work), "too slow")

    def test_quick_tests_run_before_slow_ones_each_once_and_by_its_own_program(self):
        seconds = [3.0, 0.1, 40.0, 0.2, 0.05, 2.0]
        tests = [Test("engine/toy", (f"program{k % 2}",), str(k), s) for k, s in enumerate(seconds)]
        batches = in_batches(tests)
        self.assertEqual([[test.name for test in batch] for batch in batches],
                         [["4"], ["0"], ["2"], ["1", "3"], ["5"]])
        self.assertEqual(in_batches([]), [])

    def test_a_test_that_fails_without_a_mutant_is_an_error(self):
        with self.assertRaises(RuntimeError):
            record(Test("engine/toy", ("false",), "all"), self.work)

    def test_a_mutant_without_a_meaning_leaves_a_note(self):
        source, compiled = self.work / "text.cc", self.work / "text.o"
        text, _, _ = rewritten("#include <string>\n"
                               "std::string F(std::string a, std::string b, int c, int d) { return a + b; }\n"
                               "int G(int a, int b) { return a + b; }\n"
                               "void H(int& a, int b) { a *= b; }\n")
        source.write_text(text)
        subprocess.run([*COMPILER, "-O1", "-c", source, "-o", compiled], check=True)
        self.assertEqual(shadow.impossible([compiled]), {1, 4})


def listing(program):
    """Returns a program that lists its one test as GoogleTest does."""
    asked = 'if (argc > 1 && std::strcmp(argv[1], "--gtest_list_tests") == 0) return std::puts("Toy.\\n  All") < 0;'
    return "#include <cstdio>\n#include <cstring>\n" + program.replace(
        "int main() {", "int main(int argc, char** argv) {\n  " + asked, 1)


class Soak(unittest.TestCase):
    """A whole check of a small project with one test program in GoogleTest's format."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        files = {
            "CMakeLists.txt": "cmake_minimum_required(VERSION 3.25)\nproject(toy CXX)\nset(CMAKE_CXX_STANDARD 20)\n"
                              "enable_testing()\nadd_subdirectory(tests/engine/toy)\n",
            "tests/engine/toy/CMakeLists.txt":
                "add_executable(etude_tests_engine_toy good_test.cc ../../../engine/toy/toy.cc)\n"
                "target_include_directories(etude_tests_engine_toy PRIVATE ../../../engine/toy)\n"
                "add_test(NAME engine/toy COMMAND etude_tests_engine_toy)\n",
            "engine/toy/toy.h": (HERE / "toy/toy.h").read_text(),
            # Some mutants do not compile, because strings have no difference and the size of an array must be constant.
            "engine/toy/toy.cc": (HERE / "toy/toy.cc").read_text() +
                "\n#include <string>\nstd::string Twice(const std::string& a) { return a + a; }\n"
                "extern int sized[3];\nint sized[3];\nint Unused(int a) { return a + 7; }\n",
            "tests/engine/toy/good_test.cc": listing((HERE / "toy/good_test.cc").read_text()),
        }
        for name, text in files.items():
            (cls.root / name).parent.mkdir(parents=True, exist_ok=True)
            (cls.root / name).write_text(text)
        (cls.root / ".gitignore").write_text("/out/\n")
        subprocess.run(["git", "init", "-q", cls.root], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_soak(self, *words):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            found = soak.run(soak.arguments(list(words)), self.root, self.root / "out")
        return found, said.getvalue()

    def test_it_counts_what_is_noticed_goes_on_and_keeps_its_figure(self):
        first, _ = self.run_soak("--count", "10")
        self.assertEqual(first["sample"], 10)
        found, said = self.run_soak("--count", "1000")
        self.assertIn(f"{found['sample']} mutants, {found['sample'] - 10} to be tried", said)
        self.assertEqual((found["not_compiling"], found["unreached"], found["survived"]), (5, 3, 0))
        self.assertEqual((found["sample"], found["noticed"]), (found["mutants"] - 5, found["mutants"] - 8))
        survivors = figure.load(self.root / "out/survivors.json")
        self.assertEqual({entry["code"] for entry in survivors}, {"int Unused(int a) { return a + 7; }"})
        self.assertEqual(figure.load(self.root / "out/figure.json"), found)
        self.assertIn(f"{found['sample']} mutants, 0 to be tried", self.run_soak("--count", "1000")[1])
        path = self.root / "tests/engine/toy/good_test.cc"
        path.write_text(listing("int main() {}\n"))  # the tests changed, so earlier notes are invalid
        again, said = self.run_soak("--count", "1000")
        self.assertIn(f"{found['sample']} mutants, {found['sample']} to be tried", said)
        self.assertEqual(again["noticed"], 0)


class Figure(unittest.TestCase):
    MUTANT = shadow.Mutant(7, "engine/a/a.cc", 3, 5, "<", "<=", "if (a < b) return;")

    def test_wilsons_interval_is_the_published_one(self):
        low, high = figure.wilson(81, 263)  # Newcombe 1998, table I
        self.assertAlmostEqual(low, 0.2553, places=4)
        self.assertAlmostEqual(high, 0.3662, places=4)
        self.assertEqual(figure.wilson(0, 0), (0.0, 1.0))

    def test_a_survivor_keeps_its_reason_when_its_line_has_moved(self):
        known = figure.survivors_of([(self.MUTANT, "survived")], [])
        self.assertEqual(known[0]["reason"], figure.NO_REASON)
        known[0]["reason"] = "equivalent: b is never a"
        moved = shadow.Mutant(9, "engine/a/a.cc", 30, 5, "<", "<=", "if (a < b) return;")
        again = figure.survivors_of([(moved, "survived"), (self.MUTANT, "killed")], known)
        self.assertEqual([entry["reason"] for entry in again], ["equivalent: b is never a"])

    def test_the_shares_are_of_all_and_of_those_that_differ(self):
        results = [(self.MUTANT, v) for v in ["killed"] * 7 + ["too slow", "survived", "unreached"]]
        survivors = [{"reason": "equivalent: so"}, {"reason": figure.NO_REASON}]
        kept = figure.figure_of(results, survivors, {"seed": 1})
        self.assertEqual((kept["noticed"], kept["sample"], kept["equivalent"]), (8, 10, 1))
        self.assertEqual(kept["noticed_of_all"]["share"], 0.8)
        self.assertEqual(kept["noticed_of_different"]["of"], 9)

    def test_a_sample_is_fixed_by_its_seed_and_changes_only_where_the_engine_does(self):
        mutants = [shadow.Mutant(n, "engine/a/a.cc", n, 5, "<", "<=", f"if (a < {n // 2}) return;") for n in range(400)]
        sample = soak.sample_of(mutants, 100, 1)
        self.assertEqual(sample, soak.sample_of(list(mutants), 100, 1))
        self.assertLess(len(set(sample) & set(soak.sample_of(mutants, 100, 2))), 60)
        self.assertEqual(len({mutant.number for mutant in sample}), 100)
        fewer = soak.sample_of(mutants[:-4], 100, 1)
        self.assertGreaterEqual(len(set(sample) & set(fewer)), 96)

    def test_a_line_that_was_cut_off_is_tried_again(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "verdicts.jsonl"
            path.write_text(json.dumps({"number": 1}) + '\n{"num')
            self.assertEqual(soak.complete_lines(path), ['{"number": 1}'])
            self.assertEqual(path.read_text(), '{"number": 1}\n')

    def test_every_kept_survivor_has_a_reason(self):
        for entry in figure.load(HERE / "survivors.json"):
            self.assertTrue(entry["reason"].startswith(("equivalent: ", figure.NO_REASON)), entry)


class Limits(unittest.TestCase):
    def test_a_crash_is_no_success(self):
        code, _ = run_program(["sh", "-c", "kill -SEGV $$"], {}, HERE, 5)
        self.assertEqual(code, -11)

    def test_what_sleeps_is_ended_and_what_runs_is_not(self):
        for program, is_ended in (("sleep 1000", True), ("while :; do :; done", False)):
            process = subprocess.Popen(["sh", "-c", program], start_new_session=True)
            event = threading.Event()
            timer = threading.Timer(3, event.set)
            timer.start()
            self.assertEqual(end_when_asleep(process.pid, event, 0.5), is_ended, program)
            timer.cancel()
            process.kill()
            process.wait()


if __name__ == "__main__":
    unittest.main()
