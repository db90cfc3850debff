# SPDX-License-Identifier: MIT
"""Tests of the command `encase` as a person meets it: messages, exit codes, files.

Usage: command_test.py PATH_TO_ENCASE [unittest arguments]
"""

import json
import os
import pty
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ENCASE = None

CIRCLE_AND_CUBIC = "circle: x^2 + y^2 - 1\ncubic: y = x^3\n"


def encase(*arguments, stdin="", timeout=120):
    return subprocess.run([ENCASE, *arguments], input=stdin, capture_output=True, text=True,
                          timeout=timeout)


class CommandTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name, text=None):
        path = os.path.join(self.folder.name, name)
        if text is not None:
            with open(path, "w") as file:
                file.write(text)
        return path

    def refused(self, run, code, *patterns):
        """One message on standard error that says `patterns`, nothing on standard output."""
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertTrue(run.stderr.startswith("encase: "), run.stderr)
        for pattern in patterns:
            self.assertRegex(run.stderr, pattern)

    def encased(self, run, *codes):
        self.assertIn(run.returncode, codes, run.stderr + run.stdout)
        self.assertEqual(run.stderr, "")


class Onto(CommandTest):
    def earlier(self):
        path = self.path("earlier.json")
        run = encase("curves", "-e", "circle: x^2 + y^2 - 1", "-e", "y - x^3", "--region",
                     "-2 2 -2 2", "-q", "--json", path)
        self.encased(run, 0)
        return path

    def test_adds_curves_to_a_result(self):
        later = self.path("later.json")
        run = encase("curves", "-e", "x*y - 1/3", "-e", "line: y - x/2", "--onto", self.earlier(),
                     "--json", later, "--summary")
        self.encased(run, 0)
        self.assertEqual(json.loads(run.stdout)["crossings"], 15)
        with open(later) as file:
            names = [curve["name"] for curve in json.load(file)["input"]["curves"]]
        self.assertEqual(names, ["circle", "c1", "c2", "line"])
        self.encased(encase("check", later), 0)

    def test_refuses_a_result_that_is_not_proved(self):
        path = self.earlier()
        with open(path) as file:
            result = json.load(file)
        crossing = result["crossings"][0]
        crossing["box"] = [[-0.5, -0.25], [0.5, 0.75]]
        with open(path, "w") as file:
            json.dump(result, file)
        self.refused(encase("curves", "-e", "x", "--onto", path), 1, "not proved")

    def test_refuses_what_contradicts_the_result(self):
        path = self.earlier()
        self.refused(encase("curves", "-e", "x", "--onto", path, "--region", "0 1 0 1"), 1, "--onto")
        self.refused(encase("curves", "-e", "x", "--onto", path, "--perturb", "1e-3"), 1, "--onto")
        self.refused(encase("curves", "-e", "circle: x", "--onto", path), 1, "circle")
        self.refused(encase("curves", "-e", "x", "--onto", self.path("no", "text")), 1, "no")
        self.refused(encase("curves", "-e", "x", "--onto", self.path("absent")), 2, "absent")


class Usage(CommandTest):
    def test_help_names_every_subcommand_and_the_exit_codes(self):
        run = encase("--help")
        self.encased(run, 0)
        for word in ("curves", "caps", "check", "random", "Exit codes"):
            self.assertIn(word, run.stdout)

    def test_help_of_curves_names_every_option(self):
        run = encase("curves", "--help")
        self.encased(run, 0)
        for option in ("-e", "--region", "--onto", "--json", "--svg", "--faces", "--labels", "--mesh", "-o",
                       "--history",
                       "--summary", "--relaxed", "--perturb", "--seed", "--max-cells",
                       "--max-seconds", "--max-bits", "--start-bits", "--threads", "-q", "-v"):
            self.assertIn(option, run.stdout)

    def test_version(self):
        run = encase("--version")
        self.encased(run, 0)
        self.assertRegex(run.stdout, r"^encase \d+\.\d+\.\d+\n$")

    def test_no_subcommand(self):
        self.refused(encase(), 1, "subcommand")

    def test_unknown_option(self):
        self.refused(encase("curves", "--no-such-option", "-e", "x"), 1, "--no-such-option")

    def test_unknown_subcommand(self):
        self.refused(encase("teapot"), 1, "teapot|subcommand")

    def test_neither_file_nor_expression(self):
        self.refused(encase("curves"), 1, "FILE", "-e")

    def test_file_and_expression(self):
        self.refused(encase("curves", self.path("a.curves", "x\n"), "-e", "y"), 1, "FILE", "-e")

    def test_values_that_are_no_numbers(self):
        for option in ("--max-cells", "--max-seconds", "--max-bits", "--start-bits", "--threads",
                       "--perturb", "--seed"):
            with self.subTest(option):
                self.refused(encase("curves", "-e", "x", option, "many"), 1, option)

    def test_values_out_of_range(self):
        for option, value in (("--max-cells", "0"), ("--max-seconds", "-1"), ("--max-bits", "12"),
                              ("--start-bits", "1"), ("--threads", "0"), ("--threads", "1000000"), ("--perturb", "0"),
                              ("--perturb", "nan"), ("--max-seconds", "nan"),
                              ("--perturb", "inf"), ("--perturb", "2")):
            with self.subTest(option):
                self.refused(encase("curves", "-e", "x", "--region", "-1 1 -1 1", option, value),
                             1, option)

    def test_start_bits_above_max_bits(self):
        bits = ("--start-bits", "500", "--max-bits", "200")
        for scene in (("curves", "-e", "x", "--region", "-1 1 -1 1"),
                      ("surfaces", "-e", "x", "--region", "box -1 1 -1 1 -1 1"),
                      ("slice", "-e", "x", "--region", "box -1 1 -1 1 -1 1", "--plane", "0 1 1 0")):
            self.refused(encase(*scene, *bits), 1, "--start-bits", "--max-bits")

    def test_history_needs_vtk_files(self):
        self.refused(encase("curves", "-e", "x", "--region", "-1 1 -1 1", "--history"), 1, "-o")

    def test_two_outputs_on_standard_output(self):
        region = ("-e", "x", "--region", "-1 1 -1 1")
        for outputs in (("--json", "-", "--svg", "-"), ("--summary", "--json", "-")):
            self.refused(encase("curves", *region, *outputs), 1, "standard output")

    def test_mesh_of_unknown_format(self):
        run = encase("curves", "-e", "x", "--region", "-1 1 -1 1", "--mesh", self.path("a.stl"))
        self.refused(run, 1, r"\.om.*not .*\.stl|OpenMesh")


class BadInput(CommandTest):
    REGION = "region: -2 2 -2 2\n"

    def of_text(self, text):
        return encase("curves", self.path("input.curves", text))

    def test_empty_file(self):
        self.refused(self.of_text(""), 1, "input.curves", "no curve")

    def test_unbalanced_parenthesis(self):
        run = self.of_text(self.REGION + "c: (x + y\n")
        self.refused(run, 1, r"input\.curves:2:\d+", r"\)", r"\n.*\^")

    def test_closing_parenthesis_too_many(self):
        run = self.of_text(self.REGION + "c: x + y)\n")
        self.refused(run, 1, r"input\.curves:2:9", r"\n.*\^")

    def test_unknown_variable(self):
        self.refused(self.of_text(self.REGION + "x + w\n"), 1, r"input\.curves:2:5", "w")

    def test_zero_polynomial(self):
        self.refused(self.of_text(self.REGION + "nothing: x - x\n"), 1, "nothing", "zero")

    def test_constant(self):
        self.refused(self.of_text(self.REGION + "one: 1\n"), 1, "one", "constant")

    def test_unknown_function(self):
        self.refused(self.of_text(self.REGION + "y - cbrt(x)\n"), 1, r"input\.curves:2:5", "cbrt",
                     "sqrt", r"\n.*\^")

    def test_function_without_a_parenthesis(self):
        self.refused(self.of_text(self.REGION + "y - sin x\n"), 1, r"input\.curves:2:9", "sin")

    def test_no_value_anywhere(self):
        self.refused(self.of_text(self.REGION + "void: log(-1 - x^2)\n"), 1, "void", "no value")

    def test_perturbed_expression(self):
        file = self.path("input.curves", self.REGION + "wave: y - sin(x)\n")
        run = encase("curves", file, "--perturb", "1e-8")
        self.refused(run, 1, "wave", "perturbed")

    def test_not_a_number(self):
        self.refused(self.of_text(self.REGION + "x + NaN\n"), 1, r"input\.curves:2:5", "NaN")

    def test_degree_500(self):
        self.refused(self.of_text(self.REGION + "y - x^500\n"), 1, "degree", "60")

    def test_degree_500_in_a_product(self):
        self.refused(self.of_text(self.REGION + "(x+y)^50*(x-y)^450\n"), 1, "degree|exponent",
                     "60")

    def test_huge_exponents_are_refused_at_once(self):
        start = time.monotonic()
        self.refused(self.of_text(self.REGION + "x^9999999999999999999\n"), 1)
        self.refused(self.of_text(self.REGION + "x*2^9999999999\n"), 1)
        self.refused(self.of_text(self.REGION + "x*1e9999999999\n"), 1)
        self.refused(self.of_text(self.REGION + "(" * 100000 + "x\n"), 1)
        self.assertLess(time.monotonic() - start, 10)

    def test_region_of_zero_area(self):
        self.refused(self.of_text("region: 1 1 0 1\nx\n"), 1, "region")
        self.refused(self.of_text("region: polygon (0,0) (1,1) (2,2)\nx\n"), 1, "region|polygon")

    def test_polygon_that_is_not_convex(self):
        self.refused(self.of_text("region: polygon (0,0) (2,0) (1,1/2) (0,2)\nx\n"), 1, "convex")

    def test_no_region(self):
        self.refused(self.of_text("x\n"), 1, "region: xmin xmax ymin ymax|--region")

    def test_bad_region_option(self):
        self.refused(encase("curves", "-e", "x", "--region", "1 2 3"), 1, "--region")

    def test_bad_json(self):
        run = encase("curves", self.path("input.json", '{"region": [0, 1, 0'))
        self.refused(run, 1, "input.json")

    def test_json_input(self):
        text = json.dumps({"region": [-2, 2, -2, 2], "curves": [
            {"name": "circle", "expr": "x^2 + y^2 - 1"},
            {"name": "cubic", "terms": [[0, 1, "1"], [3, 0, "-1"]]}]})
        run = encase("curves", self.path("input.json", text), "--summary")
        self.encased(run, 0)
        self.assertEqual(json.loads(run.stdout)["crossings"], 2)


class Answered(CommandTest):
    """What is not generic, or large, is answered and not refused."""

    def answered(self, text, *codes):
        run = encase("curves", "-", "--summary", stdin=text)
        self.encased(run, *codes)
        return json.loads(run.stdout)

    def test_coefficients_beyond_doubles(self):
        summary = self.answered("region: -2 2 -2 2\n1e400*x^2 + 1e400*y^2 - 1e400\ny - x^3\n", 0)
        self.assertEqual(summary["crossings"], 2)

    def test_coefficients_of_very_different_size(self):
        self.answered("region: -2 2 -2 2\n1e400*x^2 + y^2 - 1\ny - 1e-400*x^3\n", 0, 3, 4)

    def test_the_same_curve_twice(self):
        summary = self.answered("region: -2 2 -2 2\nx^2 + y^2 - 1\n2 x^2 + 2 y^2 - 2\n", 3)
        self.assertEqual(summary["status"], "degenerate")

    def test_a_circle_and_its_tangent(self):
        self.answered("region: -2 2 -2 2\nx^2 + y^2 - 1\ny - 1\n", 3, 4)

    def test_one_curve_alone(self):
        self.assertEqual(self.answered("region: -2 2 -2 2\nx^2 + y^2 - 1\n", 0)["crossings"], 0)

    def test_a_curve_outside_the_region(self):
        self.assertEqual(self.answered("region: 3 4 3 4\nx^2 + y^2 - 1\n", 0)["crossings"], 0)

    def test_curves_through_the_corners(self):
        summary = self.answered("region: -1 1 -1 1\nx - y\nx + y\n", 0)
        self.assertEqual(summary["crossings"], 1)


class Files(CommandTest):
    def curves(self):
        return self.path("input.curves", "region: -2 2 -2 2\n" + CIRCLE_AND_CUBIC)

    def test_missing_file(self):
        self.refused(encase("curves", self.path("absent.curves")), 2, r"absent\.curves", "No such")

    def test_directory_as_file(self):
        self.refused(encase("curves", self.folder.name), 2, re.escape(self.folder.name),
                     "directory")

    def test_output_in_a_missing_directory(self):
        for option in ("--json", "--svg"):
            with self.subTest(option):
                run = encase("curves", self.curves(), option, self.path("absent/result"))
                self.refused(run, 2, "absent")

    def test_output_onto_a_directory(self):
        for option in ("--json", "--svg"):
            with self.subTest(option):
                run = encase("curves", self.curves(), option, self.folder.name)
                self.refused(run, 2, "directory")

    def test_output_directory_is_a_file(self):
        run = encase("curves", self.curves(), "-o", self.path("file", "kept"))
        self.refused(run, 2 if self.vtk() else 1, "file|VTK")
        with open(self.path("file")) as file:
            self.assertEqual(file.read(), "kept")

    def vtk(self):
        return "VTK" not in encase("curves", self.curves(), "-q", "-o", self.path("probe")).stderr

    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_full_disk(self):
        with open("/dev/full", "w") as full:
            run = subprocess.run([ENCASE, "curves", self.curves(), "--json", "-", "-q"],
                                 stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(run.returncode, 2)
        self.assertRegex(run.stderr, "standard output.*[Ss]pace")

    def test_report(self):
        run = encase("curves", self.curves())
        self.encased(run, 0)
        self.assertRegex(run.stdout, r"^certified: 2 curves, 2 crossings in \d+ cells?\n")
        rows = re.findall(r"^ +\d+  circle & cubic +(\S+) +(\S+) +(\S+) +\d+$", run.stdout, re.M)
        self.assertEqual(len(rows), 2)
        for x, y, radius in rows:
            self.assertAlmostEqual(abs(float(x)), 0.8260313576541869, 15)
            self.assertAlmostEqual(float(y), float(x) ** 3, 14)
            self.assertLess(float(radius), 1e-10)

    def test_statistics(self):
        run = encase("curves", self.curves(), "-v")
        self.encased(run, 0)
        for step in ("1. sanity", "2. crossings", "3. critical regions", "4. split",
                     "5. certify"):
            self.assertIn(step, run.stdout)

    def test_quiet(self):
        run = encase("curves", self.curves(), "-q")
        self.encased(run, 0)
        self.assertEqual(run.stdout, "")

    def test_expressions_and_region_on_the_command_line(self):
        run = encase("curves", "-e", "-x^2 - y^2 = -1", "-e", "y = x^3", "--region", "-2 2 -2 2",
                     "--summary")
        self.encased(run, 0)
        summary = json.loads(run.stdout)
        self.assertEqual(summary["status"], "certified")
        self.assertEqual((summary["curves"], summary["crossings"]), (2, 2))
        self.assertEqual(set(summary), {"status", "curves", "crossings", "cells", "relaxed_cells",
                                        "pairs_met", "pairs_isolated", "filter_failures",
                                        "seconds", "vertices", "edges", "faces", "components"})
        # Two crossings, the cubic's ends and four corners; the circle in two pieces, the cubic in
        # three, the boundary in six.
        self.assertEqual([summary[key] for key in ("vertices", "edges", "faces", "components")],
                         [8, 11, 4, 1])

    def test_faces_in_the_picture(self):
        circle = ("curves", "-e", "x^2 + y^2 = 1", "--region", "-2 2 -2 2", "-q")
        run = encase(*circle, "--svg", "-", "--faces")
        self.encased(run, 0)
        self.assertEqual(run.stdout.count("<title>face "), 2)
        self.assertNotIn('id="cells"', run.stdout)
        run = encase(*circle, "--svg", "-")
        self.encased(run, 0)
        self.assertNotIn("<title>face ", run.stdout)
        self.refused(encase(*circle, "--faces"), 1, "--svg", "--mesh")

    def test_labels_in_the_picture(self):
        circle = ("curves", "-e", "x^2 + y^2 = 1", "--region", "-2 2 -2 2", "-q")
        run = encase(*circle, "--svg", "-", "--labels")
        self.encased(run, 0)
        for label in ("f1", "f2", "v0", "v3", "e0"):
            self.assertIn(f">{label}</text>", run.stdout)
        self.assertIn('id="cells"', run.stdout)
        self.refused(encase(*circle, "--labels"), 1, "--svg")

    def test_arrangement_in_the_result(self):
        run = encase("curves", self.curves(), "-q", "--json", "-")
        self.encased(run, 0)
        arrangement = json.loads(run.stdout)["arrangement"]
        self.assertEqual([len(arrangement[key]) for key in ("vertices", "edges", "faces",
                                                            "components")], [8, 11, 5, 1])
        run = encase("curves", self.curves(), "-q", "--json", "-", "--max-cells", "1")
        self.encased(run, 4)
        self.assertNotIn("arrangement", json.loads(run.stdout))

    def test_region_option_overrides_the_files(self):
        run = encase("curves", self.curves(), "--region", "polygon (0,0) (2,0) (0,2)", "--summary")
        self.encased(run, 0)
        self.assertEqual(json.loads(run.stdout)["crossings"], 1)

    def test_errors_in_expressions_name_the_expression(self):
        run = encase("curves", "-e", "x", "-e", "x + (", "--region", "-2 2 -2 2")
        self.refused(run, 1, "-e", r"\n.*\^")

    def test_result_is_the_same_bytes_every_time(self):
        paths = [self.path("a.json"), self.path("b.json")]
        for path in paths:
            self.encased(encase("curves", self.curves(), "-q", "--json", path), 0)
        with open(paths[0], "rb") as a, open(paths[1], "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_perturbation_is_in_the_result(self):
        run = encase("curves", self.curves(), "--perturb", "1e-6", "--seed", "7", "--json", "-",
                     "-q")
        self.encased(run, 0)
        again = encase("curves", self.curves(), "--perturb", "1e-6", "--seed", "7", "--json", "-",
                       "-q")
        other = encase("curves", self.curves(), "--perturb", "1e-6", "--seed", "8", "--json", "-",
                       "-q")
        self.assertEqual(run.stdout, again.stdout)
        self.assertNotEqual(run.stdout, other.stdout)
        self.assertEqual(json.loads(run.stdout)["input"]["seed"], 7)

    def test_json_on_standard_output_has_it_alone(self):
        run = encase("curves", self.curves(), "--json", "-")
        self.assertEqual(run.returncode, 0)
        self.assertEqual(json.loads(run.stdout)["format"], "encase-result")
        self.assertRegex(run.stderr, "^certified")

    def test_svg(self):
        path = self.path("a.svg")
        self.encased(encase("curves", self.curves(), "-q", "--svg", path), 0)
        with open(path) as file:
            self.assertIn("<svg", file.read())

    def test_vtk_and_mesh_files_or_the_missing_component(self):
        for option, path, name in (("-o", self.path("vtk"), "VTK"),
                                   ("--mesh", self.path("a.om"), "OpenMesh")):
            run = encase("curves", self.curves(), "-q", option, path)
            if run.returncode == 0:
                self.assertTrue(os.path.exists(path))
            else:
                self.refused(run, 1, "built without " + name)
        if run.returncode == 0:
            faces = self.path("faces.om")
            self.encased(encase("curves", self.curves(), "-q", "--mesh", faces, "--faces"), 0)
            with open(path, "rb") as cells, open(faces, "rb") as pieces:
                self.assertNotEqual(cells.read(), pieces.read())

    def test_budget_leaves_an_undecided_result(self):
        path = self.path("a.json")
        run = encase("curves", self.curves(), "--max-cells", "1", "--json", path)
        self.encased(run, 4)
        self.assertIn("undecided", run.stdout)
        with open(path) as file:
            self.assertEqual(json.load(file)["status"], "undecided")


class Examples(CommandTest):
    def test_every_shipped_example_is_certified(self):
        folder = os.path.join(os.path.dirname(__file__), "..", "..", "examples")
        files = [f for f in os.listdir(folder) if f.endswith(".curves")]
        self.assertTrue(files)
        for file in files:
            with self.subTest(file):
                self.encased(encase("curves", os.path.join(folder, file), "-q"), 0)


class Check(CommandTest):
    def result(self, text="region: -2 2 -2 2\n" + CIRCLE_AND_CUBIC):
        run = encase("curves", "-", "--json", "-", "-q", stdin=text)
        return json.loads(run.stdout)

    def checked(self, result):
        return encase("check", self.path("r.json", json.dumps(result)))

    def test_true_result(self):
        run = self.checked(self.result())
        self.encased(run, 0)
        self.assertRegex(run.stdout, r"^verified: \d+ claims")

    def test_result_on_standard_input(self):
        self.encased(encase("check", "-", stdin=json.dumps(self.result())), 0)

    def test_degenerate_result(self):
        run = self.checked(self.result("region: -2 2 -2 2\nx^2 + y^2 - 1\n2x^2 + 2y^2 - 2\n"))
        self.encased(run, 3)

    def test_changed_curve(self):
        result = self.result()
        text = json.dumps(result)
        self.assertIn('"-1"', text)
        run = encase("check", self.path("r.json", text.replace('"-1"', '"-3"')))
        self.assertEqual(run.returncode, 1, run.stdout)
        self.assertNotEqual(run.stdout, "")
        self.assertRegex(run.stderr, "^encase: .*not proved: .*objection")

    def test_dropped_crossing(self):
        result = self.result()
        result["crossings"].pop()
        self.assertEqual(self.checked(result).returncode, 1)

    def test_result_without_its_arrangement(self):
        result = self.result()
        del result["arrangement"]
        self.encased(self.checked(result), 0)

    def test_changed_arrangement(self):
        def with_other_signs(arrangement):
            for face in arrangement["faces"]:
                face["signs"] = [-sign for sign in face["signs"]]

        def with_another_parent(arrangement):
            arrangement["faces"][-1]["parent"] = 1

        def with_a_point_moved(arrangement):
            arrangement["vertices"][4]["x"] += 1e-9

        def with_a_strand_reversed(arrangement):
            cell, branch, begin, end = arrangement["edges"][0]["strands"][0]
            arrangement["edges"][0]["strands"][0] = [cell, branch, end, begin]

        for change in (with_other_signs, with_another_parent, with_a_point_moved,
                       with_a_strand_reversed):
            with self.subTest(change.__name__):
                result = self.result()
                change(result["arrangement"])
                run = self.checked(result)
                self.assertEqual(run.returncode, 1, run.stdout)
                self.assertIn("In the stored arrangement, entry ", run.stdout)
                self.assertRegex(run.stderr, "^encase: .*not proved: .*objection")

    def test_arrangement_that_is_none(self):
        result = self.result()
        result["arrangement"]["faces"][1]["outer"].pop()
        self.refused(self.checked(result), 1, r"arrangement\.faces")

    def test_no_json(self):
        self.refused(encase("check", self.path("r.json", "hello")), 1, "r.json")

    def test_json_of_something_else(self):
        self.refused(self.checked({"format": "teapot"}), 1, "encase-result|format")

    def test_missing_file(self):
        self.refused(encase("check", self.path("absent.json")), 2, "absent.json")


class Caps(CommandTest):
    LINES = ("-e", "a: x - y", "-e", "b: x + y - 1", "--region", "-1 2 -2 3")

    def test_is_exact_for_lines(self):
        run = encase("caps", *self.LINES, "-v")
        self.encased(run, 0)
        for word in ("exact", "crossing", "a & b", "boundary", "quadtree"):
            self.assertIn(word, run.stdout)

    def test_writes_every_file(self):
        out = {kind: self.path("r." + kind) for kind in ("json", "svg")}
        run = encase("caps", *self.LINES, "--json", out["json"], "--svg", out["svg"], "-q")
        self.encased(run, 0)
        self.assertEqual(run.stdout, "")
        with open(out["json"]) as file:
            result = json.load(file)
        self.assertEqual((result["command"], result["status"]), ("caps", "exact"))
        with open(out["svg"]) as file:
            self.assertIn("</svg>", file.read())
        with open(out["json"]) as file:
            self.assertEqual(encase("caps", *self.LINES, "--json", "-").stdout, file.read())

    def test_summary_and_exit_codes(self):
        run = encase("caps", *self.LINES, "--summary")
        self.encased(run, 0)
        summary = json.loads(run.stdout)
        self.assertEqual((summary["crossings"], summary["edges"]), (1, 4))
        self.assertEqual(set(summary["leaves"]),
                         {"empty", "one_curve", "several", "indeterminate"})
        touching = encase("caps", "-e", "x^2 + y^2 = 1", "-e", "x = 1", "--region", "-2 2 -2 2",
                          "--self-crossings", "--epsilon", "1e-3")
        self.encased(touching, 3)
        self.assertIn("delta-weak, delta 0.002", touching.stdout)
        few = encase("caps", *self.LINES, "--max-boxes", "50", "--summary")
        self.encased(few, 4)
        self.assertEqual(json.loads(few.stdout)["status"], "undecided")

    def test_results_are_proved_again(self):
        path = self.path("r.json")
        encase("caps", *self.LINES, "--json", path, "-q")
        run = encase("check", path)
        self.encased(run, 0)
        self.assertRegex(run.stdout, "^verified: [0-9]+ claims re-proved; exact")
        with open(path) as file:
            result = json.load(file)
        result["edges"].pop()
        with open(path, "w") as file:
            json.dump(result, file)
        run = encase("check", path)
        self.assertEqual(run.returncode, 1)
        self.assertIn("is missing", run.stdout)
        self.assertIn("is not proved: 1 objection", run.stderr)
        self.refused(encase("curves", "-e", "x = 1/3", "--onto", path), 1, "'curves' or 'slice'")
        encase("caps", "-e", "x^2 + y^2 = 1", "-e", "x = 1", "--region", "-2 2 -2 2",
               "--epsilon", "1e-3", "--json", path, "-q")
        run = encase("check", path)
        self.encased(run, 3)
        self.assertIn("a claim of the paper, and not proved", run.stdout)

    def test_refuses_what_it_cannot_do(self):
        for epsilon, text in (("0", "positive"), ("-1", "positive"), ("nan", "positive"),
                              ("5", "larger than the region")):
            self.refused(encase("caps", *self.LINES, "--epsilon", epsilon), 1, text)
        lines = self.LINES[:4]
        self.refused(encase("caps", *lines), 1, "no region")
        self.refused(encase("caps", *lines, "--region", "plane"), 1, "rectangle")
        self.refused(encase("caps", *lines, "--region", "polygon (0,0) (1,0) (0,1)"), 1,
                     "rectangle")
        self.refused(encase("caps"), 1, "FILE")
        self.refused(encase("caps", *self.LINES, "--json", "-", "--summary"), 1, "standard output")
        self.refused(encase("caps", *self.LINES, "--svg", "/nowhere/r.svg"), 2, "nowhere")

    def test_answers_what_has_poles(self):
        run = encase("caps", "-e", "y = sin(1/x)", "-e", "y = 1/x - 2", "--region", "-3 3 -3 3",
                     "--epsilon", "1e-3", "--self-crossings", "--summary")
        self.encased(run, 3)
        self.assertGreater(json.loads(run.stdout)["crossings"], 0)


class Analytic(CommandTest):
    """Curves that are not polynomials have every output that polynomials have."""
    WAVES = ("-e", "wave: y = cos(x)", "-e", "product: sin(x*y) = 0.3", "--region", "-4 4 -4 4")

    def test_json_is_proved_again(self):
        path = self.path("r.json")
        self.encased(encase("curves", *self.WAVES, "--json", path, "-q"), 0)
        run = encase("check", path)
        self.encased(run, 0)
        with open(path) as file:
            result = json.load(file)
        self.assertEqual(result["curves"][0]["expression"], "y - cos(x)")
        result["curves"][0]["expression"] = result["input"]["curves"][0]["expression"] = "y - cos(1.01*x)"
        self.assertEqual(encase("check", self.path("r.json", json.dumps(result))).returncode, 1)

    def test_picture_has_the_faces(self):
        run = encase("curves", *self.WAVES, "--svg", "-", "--faces", "-q")
        self.encased(run, 0)
        summary = json.loads(encase("curves", *self.WAVES, "--summary").stdout)
        self.assertEqual((summary["status"], summary["crossings"]), ("certified", 5))
        self.assertEqual(run.stdout.count("<title>face "), summary["faces"])
        self.assertEqual(summary["vertices"] - summary["edges"] + summary["faces"],
                         summary["components"])

    def test_vtk_files_and_mesh(self):
        mesh, folder = self.path("a.om"), self.path("vtk")
        run = encase("curves", *self.WAVES, "--mesh", mesh, "--faces", "-q")
        if run.returncode == 0:
            self.assertGreater(os.path.getsize(mesh), 1000)
        else:
            self.refused(run, 1, "built without OpenMesh")
        run = encase("curves", *self.WAVES, "-o", folder, "--history", "-q")
        if run.returncode != 0:
            return self.refused(run, 1, "built without VTK")
        with open(os.path.join(folder, "history.pvd")) as file:
            self.assertGreater(file.read().count("<DataSet"), 5)
        for block in ("cells", "curves", "faces", "edges", "vertices"):
            self.assertTrue(os.path.exists(os.path.join(folder, "result", block + ".vtp")))

    def test_added_to_polynomials_and_the_other_way(self):
        first, both = self.path("first.json"), self.path("both.json")
        circle, wave = ("-e", "circle: x^2 + y^2 = 4"), ("-e", "wave: y = sin(3x)")
        counts = []
        for before, after in ((circle, wave), (wave, circle)):
            self.encased(encase("curves", *before, "--region", "-3 3 -3 3", "--json", first, "-q"), 0)
            run = encase("curves", *after, "--onto", first, "--json", both, "--summary")
            self.encased(run, 0)
            counts.append([json.loads(run.stdout)[key] for key in ("crossings", "faces")])
            self.encased(encase("check", both), 0)
        self.assertEqual(counts, [[2, 4], [2, 4]])

    def test_poles_hold_no_zeros(self):
        path = self.path("r.json")
        run = encase("curves", "-e", "y = tan(x)", "-e", "x y = 1/2 + 1/x", "--region", "-5 5 -5 5",
                     "--json", path, "--summary")
        self.encased(run, 0)
        self.assertEqual(json.loads(run.stdout)["crossings"], 3)
        self.encased(encase("check", path), 0)

    def test_gaps_are_degenerate_and_all_else_is_certified(self):
        pole = ("-e", "y = exp(1/x)", "-e", "x^2 + y^2 = 9", "--region", "-4 4 -4 4")
        path, folder = self.path("r.json"), self.path("vtk")
        run = encase("curves", *pole, "--json", path, "--summary")
        self.encased(run, 3)
        self.assertEqual(json.loads(run.stdout)["crossings"], 3)
        self.encased(encase("check", path), 3)
        run = encase("curves", *pole, "--svg", "-", "--faces", "-q")
        self.encased(run, 3)
        self.assertTrue(run.stdout.endswith("</svg>\n"))
        run = encase("curves", *pole, "-o", folder, "--history", "-q")
        if run.returncode != 3:
            return self.refused(run, 1, "built without VTK")
        self.assertTrue(os.path.exists(os.path.join(folder, "result.vtm")))
        self.encased(encase("curves", "-e", "y = x/3", "--onto", path, "-q"), 3)


class Surfaces(CommandTest):
    SCENE = ["-e", "x^2+y^2+z^2-1", "-e", "z = 1/3", "--region", "box -2 2 -2 2 -2 2"]

    def test_summary(self):
        run = encase("surfaces", *self.SCENE, "--summary")
        self.assertEqual(run.returncode, 0, run.stderr)
        summary = json.loads(run.stdout)
        seconds = summary.pop("seconds")
        self.assertGreater(seconds, 0)
        self.assertGreater(summary.pop("cells"), 1)
        self.assertEqual(summary, {"status": "certified", "surfaces": 2, "points": 0,
                                   "intersection_curves": 1, "closed_curves": 1, "regions": 4,
                                   "euler": [2, 1], "components": [1, 1]})

    def test_files(self):
        files = {name: self.path(name) for name in ("s.json", "s.off", "vtk")}
        run = encase("surfaces", *self.SCENE, "--json", files["s.json"], "--mesh", files["s.off"],
                     "-o", files["vtk"], "--tolerance", "0.01")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("intersection curves", run.stdout)
        self.assertIn("Euler characteristic 2", run.stdout)
        with open(files["s.json"]) as file:
            result = json.load(file)
        self.assertEqual(result["command"], "surfaces")
        self.assertIn("isotopic", run.stdout)
        self.assertEqual([mesh["isotopic"] for mesh in result["meshes"]], [True, True])
        self.assertEqual(encase("check", files["s.json"]).returncode, 0)
        result["meshes"][0]["distances"][2] /= 4
        with open(files["s.json"], "w") as file:
            json.dump(result, file)
        run = encase("check", files["s.json"])
        self.assertEqual(run.returncode, 1)
        self.assertIn("the distance of triangle 2 is not proved", run.stdout)
        with open(files["s.off"]) as file:
            self.assertTrue(file.readline().endswith("OFF\n"))
        self.assertTrue(os.path.exists(os.path.join(files["vtk"], "result.vtm")))

    def test_usage(self):
        self.refused(encase("surfaces"), 1, "FILE of surfaces")
        self.refused(encase("surfaces", "-e", "x"), 1, "no region")
        self.refused(encase("surfaces", *self.SCENE, "--history"), 1, "--history")
        self.refused(encase("surfaces", *self.SCENE, "--mesh", self.path("a.stl")), 1, ".ply")
        self.refused(encase("surfaces", *self.SCENE, "--tolerance", "-1"), 1, "tolerance")
        self.refused(encase("surfaces", *self.SCENE, "--json", "-", "--summary"), 1, "only one")
        self.refused(encase("surfaces", "missing.surfaces"), 2, "missing.surfaces")


class Slice(CommandTest):
    TORUS = ["-e", "(x^2+y^2+z^2+3)^2 - 16(x^2+y^2)", "--region", "box -4 4 -4 4 -4 4"]

    def test_torus(self):
        run = encase("slice", *self.TORUS, "--plane", "0 0 1 0", "--json", self.path("t.json"),
                     "--svg", self.path("t.svg"), "--summary")
        self.assertEqual(run.returncode, 0, run.stderr)
        summary = json.loads(run.stdout)
        self.assertEqual(summary["status"], "certified")
        self.assertEqual((summary["faces"], summary["components"]), (3, 3))
        check = encase("check", self.path("t.json"))
        self.assertEqual(check.returncode, 0, check.stdout)
        # A plane that is not the one of the curves.
        with open(self.path("t.json")) as file:
            result = json.load(file)
        result["slice"]["plane"][3] = "1/2"
        with open(self.path("moved.json"), "w") as file:
            json.dump(result, file)
        self.assertEqual(encase("check", self.path("moved.json")).returncode, 1)

    def test_report_names_the_coordinates(self):
        run = encase("slice", *self.TORUS, "--plane", "1 0 0 -1/2")
        self.assertEqual(run.returncode, 0)
        self.assertIn("plane 1 0 0 -1/2; coordinates y and z", run.stdout)

    def test_count(self):
        run = encase("slice", *self.TORUS, "--plane", "1 0 0 77", "--count", "3", "--summary")
        self.assertEqual(run.returncode, 0)
        faces = [one["faces"] for one in json.loads(run.stdout)["slices"]]
        # x = -2, 0, 2: a loop, two loops, a loop.
        self.assertEqual(faces, [2, 3, 2])

    def test_expressions(self):
        run = encase("slice", "-e", "z = sin(x) cos(y)", "--region", "box -1 1 -1 1 -1 1",
                     "--plane", "0 0 1 -1/10", "--summary")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(run.stdout)["faces"], 2)

    def test_bad_input(self):
        for arguments, part in (
                (["--plane", "0 0 0 1"], "no normal"),
                (["--plane", "0 0 1"], "four numbers"),
                (["--plane", "0 0 1 0 5"], "nothing after them"),
                (["--plane", "0 0 1 100"], "does not meet the region"),
                ([], "no plane is given"),
                (["--plane", "0 0 1 0", "--count", "2", "--json", self.path("a.json")], "--count"),
                (["--plane", "0 0 1 0", "--region", "box 0 1 0 1"], "six numbers"),
                (["--plane", "0 0 1 0", "--region", "halfspaces (1,0,0,0)"], "not bounded"),
                (["--plane", "0 0 1 0", "--region", "0 1 0 1"], "region of space")):
            torus = self.TORUS[:2] if "--region" in arguments else self.TORUS
            run = encase("slice", *torus, *arguments)
            self.assertEqual(run.returncode, 1, arguments)
            self.assertIn(part, run.stderr)
            self.assertEqual(run.stdout, "")
        self.assertEqual(encase("slice", "missing.surfaces", "--plane", "0 0 1 0").returncode, 2)


class Random(CommandTest):
    def test_curves_can_be_encased(self):
        for kind in ("interpolating", "dense"):
            with self.subTest(kind):
                text = encase("random", "--degree", "4", "--count", "2", "--seed", "5", "--kind",
                              kind)
                self.encased(text, 0)
                run = encase("curves", "-", "--summary", stdin=text.stdout)
                self.encased(run, 0)
                self.assertEqual(json.loads(run.stdout)["curves"], 2)

    def test_seeds_are_natural_numbers(self):
        for seed in ("-3", "3.5"):
            self.refused(encase("random", "--degree", "2", "--seed", seed), 1, "--seed")

    def test_same_seed_gives_the_same_bytes(self):
        def draw(seed):
            return encase("random", "--degree", "3", "--count", "2", "--seed", seed).stdout
        self.assertEqual(draw("1"), draw("1"))
        self.assertNotEqual(draw("1"), draw("2"))

    def test_degree_beyond_the_limit(self):
        self.refused(encase("random", "--degree", "500", "--count", "1", "--seed", "1"), 1,
                     "degree")


class Threads(CommandTest):
    def test_any_number_gives_the_same_bytes(self):
        text = encase("random", "--degree", "6", "--count", "8", "--seed", "2").stdout
        def result(*options):
            run = encase("curves", "-", "--json", "-", "-q", *options, stdin=text)
            self.encased(run, 0)
            return run.stdout
        expected = result("--threads", "1")
        for options in (("--threads", "2"), ("--threads", "8"), ()):
            self.assertEqual(result(*options), expected, options)
        path = self.path("r.json", expected)
        self.assertEqual(encase("check", path, "--threads", "1").stdout,
                         encase("check", path, "--threads", "3").stdout)

    def test_verbose_says_how_many(self):
        run = encase("curves", "-e", "x", "--region", "-1 1 -1 1", "-v", "--threads", "4")
        self.encased(run, 0)
        self.assertRegex(run.stdout, r"threads +(at most 4|1 \(4 allowed; built without oneTBB\))")


def default_signals():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


class Interrupt(CommandTest):
    def start(self, *arguments, **streams):
        process = subprocess.Popen([ENCASE, *arguments], preexec_fn=default_signals, **streams)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def slow_curves(self):
        """Some seconds of work, of which a part is waited for."""
        return os.path.join(os.path.dirname(os.path.abspath(__file__)),
                            "../data/curves/L4_circles.curves")

    def names(self):
        return sorted(os.listdir(self.folder.name))

    def test_leaves_an_undecided_result_and_a_complete_file(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            path = self.path("r.json")
            process = self.start("curves", self.slow_curves(), "-q", "--json", path)
            time.sleep(0.5)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=60), 4)
            self.assertEqual(self.names(), ["r.json"])
            with open(path) as file:
                self.assertEqual(json.load(file)["status"], "undecided")
            os.remove(path)

    def test_stops_several_threads(self):
        curves = self.path("in.curves", encase("random", "--degree", "20", "--count", "30",
                                               "--seed", "1").stdout)
        path = self.path("r.json")
        process = self.start("curves", curves, "-q", "--json", path, "--threads", "4")
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 4)
        self.assertEqual(self.names(), ["in.curves", "r.json"])
        with open(path) as file:
            self.assertEqual(json.load(file)["status"], "undecided")

    def test_a_closed_terminal_ends_the_process_at_once(self):
        process = self.start("curves", self.slow_curves(), "-q", "--json", self.path("r.json"))
        time.sleep(0.5)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(timeout=10), 128 + signal.SIGHUP)
        self.assertEqual(self.names(), [])

    def test_while_files_are_written_leaves_only_complete_ones(self):
        curves = self.path("in.curves", encase("random", "--degree", "6", "--count", "12",
                                               "--seed", "1").stdout)
        vtk = encase("curves", "-e", "x", "--region", "-1 1 -1 1", "-q", "-o", self.path("v"))
        outputs = ["-o", self.path("out")] if vtk.returncode == 0 else []
        before = self.names()
        ended = 0
        for _ in range(4):
            process = self.start("curves", curves, "-q", "--json", self.path("r.json"), *outputs)
            # The first temporary file or directory that is seen.
            while process.poll() is None and not any(n.startswith(".") for n in self.names()):
                time.sleep(0.0005)
            process.send_signal(signal.SIGINT)
            code = process.wait(timeout=60)
            self.assertIn(code, (0, 128 + signal.SIGINT))
            ended += code != 0
            self.assertLessEqual(set(self.names()), {*before, "r.json", "out"})
            if "r.json" in self.names():
                with open(self.path("r.json")) as file:
                    json.load(file)
                os.remove(self.path("r.json"))
        if outputs:
            self.assertGreater(ended, 0)

    def test_a_result_that_is_proved_again_can_be_left(self):
        text = encase("random", "--degree", "8", "--count", "20", "--seed", "1").stdout
        path = self.path("r.json")
        encase("curves", "-", "-q", "--json", path, stdin=text)
        process = self.start("check", path)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        # (The shell shows 130 for a process that the signal kills while it reads.)
        self.assertIn(process.wait(timeout=60), (0, -signal.SIGINT, 128 + signal.SIGINT))


class ProgressShown(CommandTest):
    def on_terminal(self, *arguments):
        """What goes to standard error where that is a terminal."""
        master, slave = pty.openpty()
        process = subprocess.Popen([ENCASE, *arguments], stdout=subprocess.DEVNULL, stderr=slave)
        os.close(slave)
        shown = b""
        try:
            while piece := os.read(master, 4096):
                shown += piece
        except OSError:  # the other end is closed
            pass
        os.close(master)
        process.wait()
        return shown.decode()

    def test_for_work_of_more_than_a_second(self):
        curves = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                              "../data/curves/L4_circles.curves")
        shown = self.on_terminal("curves", curves, "--max-seconds", "2")
        self.assertRegex(shown, r"critical regions")
        self.assertTrue(shown.endswith("\r\x1b[K"), repr(shown))
        self.assertEqual(self.on_terminal("curves", curves, "--max-seconds", "2", "-q"), "")

    def test_not_for_less(self):
        self.assertEqual(self.on_terminal("curves", "-e", "x", "--region", "-1 1 -1 1"), "")


if __name__ == "__main__":
    ENCASE = os.path.abspath(sys.argv.pop(1))
    unittest.main()
