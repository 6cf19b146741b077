#!/usr/bin/env python3
"""The gates of the pages find what they are for: each is tried on pages that break its rule."""

import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).parent), str(pathlib.Path(__file__).parents[1] / "support")]
import decisions_gate
import glossary_gate
import tree_of_files  # noqa: E402
import theory_gate

ROOT = pathlib.Path(__file__).resolve().parents[2]


def draw_architecture():
    """The script as a module; it has no .py."""
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader("draw", str(ROOT / "tools/dev/draw_architecture"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("draw", loader))
    loader.exec_module(module)
    return module


DECISION = """# 0001 A title
State: accepted.

## Context
a

## Decision
b

## Consequences
c

## Figures
d

## Tried and dropped
e
"""


class Tree(tree_of_files.Tree):
    def said(self, problems):
        return "\n".join(text for _, _, text in problems)


class Theory(Tree):
    def problems(self, page, code="// docs/theory/a.md, eq. (1)\n", derivations=None):
        self.write("docs/theory/a.md", page)
        self.write("core/a.cpp", code)
        return self.said(theory_gate.problems(self.root, derivations or {}))

    def test_a_numbered_and_cited_equation_passes(self):
        self.assertEqual(self.problems("$$ a = b \\tag{1} $$\n"), "")

    def test_an_equation_without_a_number_is_found(self):
        self.assertIn("no number", self.problems("$$ a = b \\tag{1} $$\n\n$$ c = d $$\n"))

    def test_a_number_given_twice_is_found(self):
        self.assertIn("given twice", self.problems("$$ a \\tag{1} $$\n\n$$ b \\tag{1} $$\n"))

    def test_an_equation_in_plain_text_is_found(self):
        self.assertIn("plain text", self.problems("$$ a \\tag{1} $$\n\n    a = b + c\n"))

    def test_a_cited_number_that_does_not_exist_is_found(self):
        self.assertIn("no equation (2)", self.problems(
            "$$ a \\tag{1} $$\n", "// docs/theory/a.md, eq. (1), (2)\n"))

    def test_a_cited_page_that_does_not_exist_is_found(self):
        self.assertIn("no page", self.problems(
            "$$ a \\tag{1} $$\n", "// docs/theory/a.md, eq. (1)\n// docs/theory/b.md, eq. (1)\n"))

    def test_an_equation_that_no_stage_cites_is_found(self):
        self.assertIn("cites equation (2)", self.problems("$$ a \\tag{1} $$\n\n$$ b \\tag{2} $$\n"))

    def test_the_list_of_uncited_equations_only_shrinks(self):
        self.write("docs/theory/a.md", "$$ a \\tag{1} $$\n\n$$ b \\tag{2} $$\n")
        self.write("core/a.cpp", "// docs/theory/a.md, eq. (1)\n")
        self.assertEqual(self.said(theory_gate.problems(self.root, {}, {("a", "2")})), "")
        self.assertIn("equation (1) is cited by now", self.said(
            theory_gate.problems(self.root, {}, {("a", "1"), ("a", "2")})))

    def test_a_derivation_that_is_cited_is_found(self):
        self.assertIn("listed as a derivation",
                      self.problems("$$ a \\tag{1} $$\n", derivations={"a": {1}}))


class Decisions(Tree):
    def problems(self, text, name="0001_a.md"):
        self.write("docs/decisions/" + name, text)
        return self.said(decisions_gate.problems(self.root))

    def test_a_whole_decision_passes(self):
        self.assertEqual(self.problems(DECISION), "")

    def test_a_heading_that_is_missing_is_found(self):
        self.assertIn("the headings are", self.problems(DECISION.replace("## Figures\n", "")))

    def test_an_empty_part_is_found(self):
        self.assertIn("nothing stands under `Figures`",
                      self.problems(DECISION.replace("## Figures\nd\n", "## Figures\n")))

    def test_a_state_that_says_nothing_is_found(self):
        self.assertIn("second line", self.problems(DECISION.replace("accepted", "replaced")))

    def test_a_gap_in_the_numbers_is_found(self):
        self.assertIn("number 0001", self.problems(DECISION, "0002_a.md"))

    def test_a_decision_named_by_code_that_does_not_exist_is_found(self):
        self.write("core/a.cpp", "// docs/decisions/0009_b.md\n")
        self.assertIn("no decision 0009_b.md", self.problems(DECISION))


class Glossary(Tree):
    def problems(self, rows):
        self.write("docs/architecture/glossary.md",
                   "# Glossary\n\n| term | meaning | source |\n| --- | --- | --- |\n" + rows)
        return self.said(glossary_gate.glossary_problems(self.root / "docs/architecture/glossary.md"))

    def test_whole_rows_in_order_pass(self):
        self.assertEqual(self.problems("| a | b | c |\n| b | c | d |\n"), "")

    def test_a_row_without_a_source_is_found(self):
        self.assertIn("a source", self.problems("| a | b | |\n"))

    def test_disorder_and_doubles_are_found(self):
        self.assertIn("stands behind", self.problems("| b | c | d |\n| a | b | c |\n"))
        self.assertIn("given twice", self.problems("| a | b | c |\n| a | b | c |\n"))

    def test_links_to_nowhere_are_found(self):
        self.write("docs/a.md", "# One heading\n[a](a.md#one-heading) [b](b.md)\n[c](a.md#two) `[d](d)`\n")
        said = self.said(glossary_gate.link_problems(self.root))
        self.assertIn("b.md leads nowhere", said)
        self.assertIn("a.md#two names a heading", said)
        self.assertNotIn("one-heading", said)
        self.assertNotIn("(d)", said)

    def test_files_that_are_named_and_not_there_are_found(self):
        self.write("core/a.cpp", "")
        self.write("docs/theory/a.md", "`core/a.cpp` and `core/b.cpp` and `core/<x>/c.cpp`\n")
        self.assertEqual(self.said(glossary_gate.path_problems(self.root)), "there is no core/b.cpp")

    def test_commands_of_generated_pages_that_are_not_there_are_found(self):
        self.write("tools/run", "")
        self.write("docs/validation/a.md", "Written by `tools/record a` and `tools/run a`, to `docs/figures/PAGE.csv`.\n")
        self.assertEqual(self.said(glossary_gate.path_problems(self.root)), "there is no tools/record")


class Diagrams(unittest.TestCase):
    draw = draw_architecture()
    DOT = """digraph dust {
  subgraph "cluster_step" {
    "step.emit" [label="emit", tooltip="reads: a"];
    "step.sensor one" [label="sensor one"];
    "step.sensor two" [label="sensor two"];
    subgraph "cluster_step.tile" {
    label="per tile"; style=dashed;
    "step.contact" [label="contact"];
    }
    "step.emit" -> "step.sensor one";
    "step.emit" -> "step.sensor two";
  }
  "step.emit" -> "inner.drag" [style=dashed];
}
"""

    def test_the_rooms_are_those_that_are_built(self):
        rooms = {room: uses for room, (uses, _) in self.draw.rooms().items()}
        self.assertIn("base", rooms["particles"])
        self.assertEqual(rooms["base"], set())

    def test_edges_that_a_longer_way_replaces_are_left_out(self):
        self.assertEqual(self.draw.without_shortcuts([("a", "b"), ("b", "c"), ("a", "c")]),
                         [("a", "b"), ("b", "c")])
        circle = [("a", "b"), ("b", "a"), ("a", "c")]
        self.assertEqual(self.draw.without_shortcuts(circle), circle)

    def test_nodes_and_edges_come_from_the_dot_text_and_sensors_are_one(self):
        self.assertEqual(list(self.draw.clusters(self.DOT)), ["step"])
        nodes, edges, parts = self.draw.clusters(self.DOT)["step"]
        self.assertEqual(nodes, ["emit", "sensor one", "sensor two", "contact"])
        drawn = self.draw.graph_diagram("step", nodes, edges, parts)
        self.assertIn('subgraph box_0["per tile"]\n    step_contact["contact"]\n  end', drawn)
        self.assertEqual(drawn.count("step_sensors["), 1)
        self.assertEqual(drawn.count("step_emit --> step_sensors"), 1)

    def test_a_node_that_the_table_does_not_explain_is_found(self):
        page = "<!-- end of step -->\n\n| node | what |\n| --- | --- |\n| emit, sensors | a |\n\nmore\n"
        self.assertEqual(self.draw.unexplained(page, "step", ["emit", "sensor one", "fluid"]), ["fluid"])

    def test_nodes_that_the_drawn_scenario_has_not_are_found_in_the_source(self):
        source = 'dem_graph_.add({"drag",\n  if (dust_) step_graph_.add({"dust",\n step_graph_.add(\n      {"emit", {"a"}'
        self.assertEqual(self.draw.nodes_in_source(source), {"fluid_step": ["dust", "emit"], "dem_step": ["drag"]})
        self.assertIn("liberation", self.draw.nodes_in_source(self.draw.GRAPH_SOURCE.read_text())["fluid_step"])

    def test_a_stale_diagram_is_replaced_between_its_marks(self):
        page = "a\n<!-- x: drawn by tools/dev/draw_architecture -->\nold\n<!-- end of x -->\nb\n"
        self.assertEqual(self.draw.replaced(page, "x", "new"), page.replace("old", "new"))


if __name__ == "__main__":
    unittest.main()
