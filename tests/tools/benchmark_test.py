# SPDX-License-Identifier: MIT
"""A short run of encase_benchmark: what it prints and writes is there and makes sense. No times
are compared.

Usage: benchmark_test.py PATH_TO_ENCASE_BENCHMARK [unittest arguments]
"""

import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

BENCHMARK = None
SHORT = ("--degrees", "2,3", "--seeds", "1", "--repeat", "1", "--most-curves", "30")
PAIRS_AND_SETTINGS = [(2, "default"), (2, "fast"), (3, "default"), (3, "fast")]


def benchmark(*arguments, timeout=500):
    return subprocess.run([BENCHMARK, *arguments], capture_output=True, text=True, timeout=timeout)


class ShortRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.csv = os.path.join(cls.folder.name, "tables.csv")
        json_file = os.path.join(cls.folder.name, "tables.json")
        markdown = os.path.join(cls.folder.name, "tables.md")
        cls.run_ = benchmark(*SHORT, "--csv", cls.csv, "--json", json_file, "--markdown", markdown)
        if cls.run_.returncode != 0:
            raise AssertionError(cls.run_.stderr)
        with open(json_file) as file:
            content = json.load(file)
        cls.machine, cls.tables = content["machine"], content["tables"]
        with open(markdown) as file:
            cls.markdown = file.read()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_prints_the_machine_and_every_table(self):
        self.assertEqual(self.run_.stderr, "")
        self.assertEqual(self.run_.stdout.splitlines()[0], self.machine)
        for title in ("a floor is four Newton steps", "The curves of tests/data/curves",
                      "Curves that nearly touch", "The most memory"):
            self.assertIn(title, self.run_.stdout)
            self.assertIn(title, self.markdown)

    def test_random_pairs_are_certified_with_times_and_floors(self):
        self.assertEqual([(row["degree"], row["setting"]) for row in self.tables["floors"]],
                         PAIRS_AND_SETTINGS)
        for row in self.tables["floors"]:
            self.assertEqual(row["outcome"], "certified")
            for column in ("floor us", "together us", "isolation us", "encasement ms", "floors"):
                self.assertGreater(row[column], 0, column)

    def test_newton_steps_of_the_floor_end_at_the_crossings(self):
        self.assertEqual([(row["degree"], row["setting"]) for row in self.tables["pairs"]],
                         PAIRS_AND_SETTINGS)
        for row in self.tables["pairs"]:
            self.assertLess(row["Newton error"], 1e-12)

    def test_cells_are_counted_and_not_fewer_than_crossings(self):
        for row in self.tables["work"]:
            self.assertGreaterEqual(row["cells"], row["crossings"])
            self.assertGreater(row["root boxes"], 0)
            self.assertGreater(row["by double"], 0)
        self.assertEqual(self.tables["work"][0]["authors' cells"], "7-10")

    def test_common_points_in_space_are_all_proved(self):
        self.assertEqual([row["degree"] for row in self.tables["space"]], [2, 3])
        for row in self.tables["space"]:
            self.assertGreater(row["boxes"], 0)
            self.assertEqual(row["rounded"], "all")
            self.assertEqual(row["unresolved"], 0)
            for column in ("floor us", "ms", "floors", "with setup ms", "ms for them"):
                self.assertGreater(row[column], 0, column)

    def test_encasements_in_space_are_certified_and_proved_again(self):
        self.assertEqual([row["degree"] for row in self.tables["surfaces"]], [2, 3])
        for row in self.tables["surfaces"]:
            self.assertEqual((row["certified"], row["verified"]), ("all", "all"))
            self.assertGreater(row["cells"], 0)
            for column in ("encasement ms", "arrangement ms", "curves to 1e-3 ms"):
                self.assertGreater(row[column], 0, column)

    def test_all_files_of_the_directory_are_encased(self):
        rows = {row["curves"]: row for row in self.tables["files"] if row["setting"] == "default"}
        self.assertEqual(rows["haas_drrs_sparse"]["outcome"], "certified")
        self.assertEqual(rows["haas_drrs_sparse"]["crossings"], 5)
        self.assertEqual(rows["degenerate_cusp_vs_y0"]["outcome"], "degenerate")
        self.assertEqual(rows["chebsuite_2_4"]["crossings"], 93)
        for k in range(7, 13):
            self.assertEqual(rows[f"cxy_{k}"]["outcome"], "certified")
        # One oval; two branches; five crossings.
        for name, least in (("linyap_1", 2), ("y2_close_lines", 2), ("haas_drrs_sparse", 5)):
            self.assertEqual(rows[name]["least"], least, name)

    def test_near_tangencies_include_the_parabolas(self):
        rows = {row["curves"]: row for row in self.tables["near tangencies"]}
        self.assertEqual(len(rows), 13)
        self.assertGreater(rows["parabolas 1e-6 apart, relaxed"]["relaxed"], 0)
        self.assertEqual(rows["circle and line, overlap 1e-4"]["crossings"], 2)
        self.assertEqual(rows["circle and line, gap 1e-4"]["crossings"], 0)

    def test_cgal_finds_the_same_crossings(self):
        if "without CGAL" in self.machine:
            self.assertNotIn("cgal", self.tables)
            return
        self.assertEqual([(row["degree"], row["setting"]) for row in self.tables["cgal"]],
                         PAIRS_AND_SETTINGS)
        for row in self.tables["cgal"]:
            self.assertEqual(row["the same"], "yes")
            self.assertEqual(row["CGAL's"], row["in the box"])
            self.assertGreater(row["CGAL ms"], row["without coordinates ms"])
            self.assertGreater(row["ratio"], row["ratio without coordinates"])

    def test_circles_cross_as_often_as_their_distances_say(self):
        self.assertEqual([row["circles"] for row in self.tables["circles"]], [30])
        for row in self.tables["circles"]:
            self.assertEqual(row["certified"], "yes")
            self.assertGreater(row["crossings"], 0)
            self.assertEqual(row["crossings"], row["by distances"])
            self.assertGreater(row["MB"], 0)

    def test_arcs_have_the_nodes_and_edges_of_an_arrangement(self):
        self.assertEqual([(row["degree"], row["curves"]) for row in self.tables["arcs"]],
                         [(9, 20)])
        for row in self.tables["arcs"]:
            self.assertEqual(row["certified"], "yes")
            self.assertGreater(row["nodes"], row["crossings"])
            self.assertGreaterEqual(row["pairs met"], row["isolated"])

    def test_arrangements_are_those_that_cgal_finds(self):
        rows = self.tables["arrangements"]
        self.assertEqual([row["curves"] for row in rows], [10, 20, 30])
        for row in rows:
            if "without CGAL" in self.machine:
                self.assertNotIn("the same", row)
            else:
                self.assertEqual(row["the same"], "yes")

    def test_csv_holds_the_same_tables(self):
        with open(self.csv, newline="") as file:
            rows = list(csv.reader(file))
        titles = [row[0] for row in rows if row and row[0].startswith("# ")]
        self.assertEqual(len(titles), len(self.tables))
        pairs = rows.index(["# Every random pair; times in seconds"])
        header, first = rows[pairs + 1], rows[pairs + 2]
        self.assertEqual(len(header), len(first))
        self.assertEqual(float(first[header.index("encasement")]),
                         self.tables["pairs"][0]["encasement"])


class Chapter5(unittest.TestCase):
    def test_writes_every_figure_as_data_and_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            plots = os.path.join(folder, "new", "plots")
            run = benchmark("chapter5", "-o", plots, *SHORT)
            self.assertEqual(run.returncode, 0, run.stderr)
            with_cgal = "without CGAL" not in run.stdout
            for figure in range(3, 13):
                name = os.path.join(plots, f"figure-5.{figure}")
                if not with_cgal and figure in (4, 6, 8, 10, 11):
                    self.assertFalse(os.path.exists(name + ".svg"))
                    continue
                root = ElementTree.parse(name + ".svg").getroot()
                texts = [e.text for e in root.iter("{http://www.w3.org/2000/svg}text")]
                self.assertIn("degree", texts)
                self.assertTrue(any(f"(5.{figure})" in text for text in texts))
                with open(name + ".csv", newline="") as file:
                    rows = list(csv.reader(file))
                self.assertEqual([row[0] for row in rows], ["degree", "2", "3"])
                for row in rows[1:]:
                    self.assertTrue(all(float(entry) > 0 for entry in row if entry), row)
                if figure == 9:
                    self.assertEqual(rows[0], ["degree", "encasement", "CGAL"])
                    self.assertTrue(rows[2][1])
                    self.assertEqual(bool(rows[2][2]), with_cgal)
                if figure == 12:
                    self.assertEqual(len(rows[0]), 6)

    def test_a_directory_that_cannot_be_made_is_an_error(self):
        run = benchmark("chapter5", "-o", "/dev/null/plots", *SHORT)
        self.assertEqual(run.returncode, 1)
        self.assertIn("/dev/null/plots", run.stderr)


class Usage(unittest.TestCase):
    def refused(self, *arguments):
        run = benchmark(*arguments)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(run.stdout, "")
        self.assertTrue(run.stderr.startswith("encase_benchmark: "), run.stderr)
        return run.stderr

    def test_unknown_options_and_values_are_refused(self):
        self.assertIn("--help", self.refused("--fast-and-loose"))
        self.assertIn("--degrees", self.refused("--degrees", "61"))
        self.assertIn("-o", self.refused("chapter5"))
        self.assertIn("--only", self.refused("--only", "nothing"))
        self.assertIn("--curves", self.refused("--curves", "/no/such/directory"))

    def test_help_names_the_options(self):
        run = benchmark("--help")
        self.assertEqual(run.returncode, 0)
        for option in ("--degrees", "--seeds", "--cgal-degrees", "--repeat",
                       "--most-curves", "--csv", "--json"):
            self.assertIn(option, run.stdout)

    def test_a_file_that_cannot_be_written_is_an_error(self):
        run = benchmark("--only", "growth", "--degrees", "2", "--seeds", "1", "--repeat", "1",
                        "--csv", "/no/such/directory/tables.csv")
        self.assertEqual(run.returncode, 1)
        self.assertIn("/no/such/directory", run.stderr)


if __name__ == "__main__":
    BENCHMARK = sys.argv.pop(1)
    unittest.main()
