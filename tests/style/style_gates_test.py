#!/usr/bin/env python3
"""The gates of the style find what they are for: each is tried on sources that break its rule."""

import pathlib
import shutil
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).parent), str(pathlib.Path(__file__).parents[1] / "support")]
import allow_list
import approx_gate
import folders_gate
import format_gate
import functions_gate
import scripts_gate
import test_names_gate
import tree_of_files  # noqa: E402
import types_gate
import words_gate

GLOSSARY = """# Glossary
## Words that identifiers do not use
| not | but |
| --- | --- |
| `watch`, `look_out` | list |
| `chunk` (`core/io`) | tile |
"""
LONG_BODY = "".join(f"  f({n});\n" for n in range(60))
SHORT_BODY = "  f(1);\n"


class Words(tree_of_files.Tree):
    def found(self, code, path="core/a.cpp"):
        self.write("docs/architecture/glossary.md", GLOSSARY)
        self.write(path, code)
        return set(words_gate.findings(self.root))

    def test_words_are_found_in_both_ways_of_writing_names(self):
        self.assertEqual(self.found("int begin_watch; struct WatchList {}; int k_look_out_;"),
                         {"begin_watch", "WatchList", "k_look_out_"})

    def test_parts_of_words_comments_and_strings_are_not_meant(self):
        self.assertEqual(self.found("int stopwatch; // watch\n/* watch */ f(\"watch\", 'w');\n"
                                    "auto r = R\"(watch)\"; int n = 1'000; int m = 2'000;"), set())

    def test_a_word_is_right_in_its_own_folder(self):
        self.assertEqual(self.found("int chunk;", "core/io/a.cpp"), set())
        self.assertEqual(self.found("int chunk;", "core/run/a.cpp"), {"chunk"})


class Approx(tree_of_files.Tree):
    def test_doctests_own_is_found_and_the_projects_is_not(self):
        self.write("tests/unit/a_test.cpp", "CHECK(x == test::approx(1e-9));\nCHECK(y == doctest::Approx(1e-9));\n")
        self.write("tests/support/approx.hpp", "return doctest::Approx(expected).scale(1e-300);\n")
        (only,) = approx_gate.findings(self.root)
        self.assertIn("a_test.cpp:2", only)


class Scripts(tree_of_files.Tree):
    def test_scripts_are_found_by_their_first_line_and_python_that_does_not_compile(self):
        self.write("tools/run", "#!/bin/sh\necho\n")
        self.write("tools/dev/fuzz", "#!/usr/bin/env python3\nif x\n")
        self.write("tools/page.py", "x = 1\n")
        self.write("tools/README.md", "# a page\n")
        shell, python, problems = scripts_gate.findings(self.root, None)
        self.assertEqual((shell, python), (1, 2))
        self.assertEqual(len(problems), 1)
        self.assertIn("fuzz:2", problems[0])

    @unittest.skipUnless(shutil.which("shellcheck"), "needs shellcheck")
    def test_what_shellcheck_finds_is_told(self):
        self.write("tools/run", "#!/bin/sh\nrm $1\n")
        self.assertIn("SC2086", "".join(scripts_gate.findings(self.root, "shellcheck")[2]))


class Functions(tree_of_files.Tree):
    def found(self, code):
        self.write("core/a.cpp", code)
        return set(functions_gate.findings(self.root))

    def test_long_functions_are_found_wherever_they_stand(self):
        inside = "".join("  " + line + "\n" for line in LONG_BODY.split("\n"))
        self.assertEqual(
            self.found("namespace a {\n\nint Thing::first(int a,\n    int b) {\n" + LONG_BODY +
                       "}\n\nclass Other {\n public:\n  void second() const {\n" + inside +
                       "  }\n};\n\n}  // namespace a\n"),
            {"core/a.cpp Thing::first", "core/a.cpp Other::second"})

    def test_short_functions_types_tables_and_kernels_pass(self):
        self.assertEqual(
            self.found("enum class E {\n  a = 1,\n  b\n};\n\nstruct Data {\n" +
                       "".join(f"  int a{n};\n" for n in range(70)) + "};\n\n" +
                       "constexpr std::array k_table = {\n" +
                       "".join(f"  g({n}),\n" for n in range(70)) + "};\n\n" +
                       "void one() {\n" + SHORT_BODY + "}\n\nDUST_KERNEL void two() {\n" +
                       LONG_BODY + "}\n\nvoid three() {\n" + SHORT_BODY + "}\n"), set())

    def test_a_limit_is_a_limit(self):
        body = "".join(f"  f({n});\n" for n in range(58))
        self.assertEqual(self.found("void a() {\n" + body + "}\n"), set())
        self.assertEqual(self.found("void a() {\n" + body + "  f();\n}\n"), {"core/a.cpp a"})


class Folders(tree_of_files.Tree):
    def test_units_are_counted_once_and_only_shrink(self):
        for n in range(16):
            self.write(f"core/a/unit_{n}.hpp", "")
            self.write(f"core/a/unit_{n}.cpp", "")
        found = folders_gate.counts(self.root)
        self.assertEqual(found, {"core/a": 16})
        self.assertIn("up to 15", "".join(folders_gate.problems(found, {})))
        self.assertIn("takes none", "".join(folders_gate.problems({"core/a": 17}, {"core/a": 16})))
        self.assertIn("smaller number", "".join(folders_gate.problems(found, {"core/a": 20})))
        self.assertIn("take it out", "".join(folders_gate.problems({}, {"core/a": 20})))
        self.assertEqual(list(folders_gate.problems(found, {"core/a": 16})), [])


class Types(tree_of_files.Tree):
    def found(self, code, path="core/a.hpp"):
        self.write(path, code)
        return set(types_gate.findings(self.root))

    def test_public_data_of_a_type_that_changes_itself_are_found(self):
        code = "struct Sum {\n  double value = 0.0;\n  void add(double x);\n};\n"
        self.assertEqual(self.found(code), {"public_data Sum"})

    def test_types_inside_types_have_their_full_names(self):
        self.assertEqual(
            self.found("class Outer {\n public:\n  struct Inner {\n    int a[3] = {1, 2, 3}, b;\n"
                       "    void set() {\n      a[0] = 1;\n    }\n  };\n\n private:\n  int c_;\n};\n"),
            {"public_data Outer::Inner"})

    def test_aggregates_and_values_pass(self):
        self.assertEqual(
            self.found("struct View {\n  const double* x = nullptr;\n  std::map<int, f(int)> m;\n"
                       "  double at(int i) const { return x[i]; }\n  View& operator+=(const View& v);\n"
                       "  __attribute__((always_inline)) static inline View of(int n) {\n    return {};\n"
                       "  }\n  constexpr static int k_n = 3;\n"
                       "  static View make(int n);\n  View() = default;\n  explicit View(int n);\n"
                       "  int (*count)(int) = nullptr;\n};\n"), set())

    def test_types_of_a_source_may_be_open_but_not_large(self):
        members = "".join(f"  int a{n}, b{n};\n" for n in range(8))
        code = "struct Impl {\n" + members + "  void step();\n};\n"
        self.assertEqual(self.found(code, "core/a.cpp"), {"members Impl"})
        self.assertEqual(self.found(code.replace(", b0", ""), "core/a.cpp"), set())

    def test_members_with_initialisers_over_lines_end_where_they_end(self):
        self.assertEqual(
            self.found("class A {\n  std::array<int, 2> a_{\n      1,\n      2};\n  void f();\n\n"
                       " public:\n  int b = 0;\n};\n"), {"public_data A"})


class Spread(tree_of_files.Tree):
    def test_a_class_in_three_sources_is_found_and_namespaces_are_not_meant(self):
        for name in "abc":
            self.write(f"core/{name}.cpp", f"void Dem::{name}() {{\n  f();\n}}\n\n"
                                           f"void formula::{name}() {{\n  f();\n}}\n")
        self.assertEqual(set(types_gate.findings(self.root)), {"sources Dem"})

    def test_an_impl_in_foreign_hands_is_found(self):
        self.write("core/a.cpp", "struct Dem::Impl {\n  int a;\n};\n\nvoid Dem::f() {\n  g();\n}\n")
        self.write("core/b.hpp", "void take(const Dem::Impl& dem);\n")
        self.assertEqual(types_gate.findings(self.root), {"impl Dem": "core/b.hpp"})


class TestNames(tree_of_files.Tree):
    def test_both_ways_round(self):
        self.write("tests/a.cpp", "TEST_CASE(\"a shall b\") {}\n")
        self.write("tests/b_test.cpp", "int main() {}\n")
        self.write("tests/c_test.cpp", "  TEST_CASE_TEMPLATE(\"c \"\n  \"shall d\", T, int) {}\n")
        self.write("tests/d.cpp", "int helper();\n")
        self.assertEqual(set(test_names_gate.findings(self.root)), {"tests/a.cpp", "tests/b_test.cpp"})

    def test_a_name_that_does_not_say_what_shall_be_is_found(self):
        self.write("tests/a_test.cpp", "TEST_CASE(\"a does b\") {}\nTEST_CASE(\"a shall b\") {}\n")
        self.assertEqual(set(test_names_gate.findings(self.root)), {"tests/a_test.cpp: a does b"})


class Format(tree_of_files.Tree):
    def test_a_line_that_is_not_formatted_is_found(self):
        program, why = format_gate.formatter()
        if program is None:
            self.skipTest(why)
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("core/good.cpp", "int a = 1;\n")
        self.write("core/bad.cpp", "int b = 1;\nint   c = 1;\n")
        found = format_gate.unformatted(program, self.root, ["core/good.cpp", "core/bad.cpp"])
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("core/bad.cpp:2:"), found)


class AllowLists(tree_of_files.Tree):
    def test_new_and_gone_entries_are_told_and_the_gone_taken_out(self):
        path = self.root / "allowed.txt"
        path.write_text("# head\ngone\nkept\n")
        said = list(allow_list.differences({"kept": "a.cpp:1", "new": "a.cpp:2"},
                                           allow_list.read(path), "allowed.txt", "rename"))
        self.assertEqual(said, ["a.cpp:2: new: rename",
                                "allowed.txt: gone is allowed and no longer there; take it out"])
        self.assertEqual(allow_list.run({"kept": "a.cpp:1"}, path, "rename", ["--shrink"]), 0)
        self.assertEqual(path.read_text(), "# head\nkept\n")


if __name__ == "__main__":
    unittest.main()
