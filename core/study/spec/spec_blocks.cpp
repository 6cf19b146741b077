// SPDX-License-Identifier: Apache-2.0
#include "study/spec/spec_blocks.hpp"

#include "study/spec/spec.hpp"

namespace dust::study {

using sdk::SchemaOf;

const sdk::ParameterSchema& GeneralBlock::schema() {
  static const sdk::ParameterSchema made = [] {
    SchemaOf<GeneralBlock> s;
    s.text(&GeneralBlock::name, "name",
           "Name of the study and of its folder; without it, the file's stem.")
        .optional();
    s.text(&GeneralBlock::title, "title", "One sentence for the report.").optional();
    s.text(&GeneralBlock::base, "base", "The scenario that is varied, relative to this file.");
    s.integer(&GeneralBlock::replicates, "replicates",
              "Runs of every point, each with a seed of its own.")
        .at_least(1)
        .at_most(1000)
        .optional();
    s.integer(&GeneralBlock::seed, "seed",
              "Seed of the first replicate; the next ones count on. -1 takes the scenario's.")
        .at_least(-1)
        .optional();
    return s.build();
  }();
  return made;
}

const sdk::ParameterSchema& MeasureBlock::schema() {
  static const sdk::ParameterSchema made = [] {
    SchemaOf<MeasureBlock> s;
    s.text(&MeasureBlock::quantity, "quantity",
           "sensors.SENSOR.FIGURE, or a figure of summary.json.");
    s.text(&MeasureBlock::minus, "minus", "A second quantity that is taken off.").optional();
    s.text(&MeasureBlock::unit, "unit", "Another unit than that of the quantity.").optional();
    return s.build();
  }();
  return made;
}

const sdk::ParameterSchema& ExpectationBlock::schema() {
  static const sdk::ParameterSchema made = [] {
    SchemaOf<ExpectationBlock> s;
    s.text(&ExpectationBlock::output, "output", "Name of a measure.");
    s.text(&ExpectationBlock::input, "input", "Path of what is varied, or `case`.");
    s.text(&ExpectationBlock::then, "then",
           "From the smallest number of the input to its largest, of other values from the first "
           "that is given to the last, or from one case to another.")
        .one_of({"rises", "falls"});
    s.text(&ExpectationBlock::from, "from", "Of cases: the one that it changes from.").optional();
    s.text(&ExpectationBlock::to, "to", "Of cases: the one that it changes to.").optional();
    s.text(&ExpectationBlock::why, "why", "For the report.").optional();
    return s.build();
  }();
  return made;
}

const sdk::ParameterSchema& Execution::schema() {
  static const sdk::ParameterSchema made = [] {
    SchemaOf<Execution> s;
    s.integer(&Execution::jobs, "jobs", "Runs at a time; 0 takes what the cores allow.")
        .at_least(0)
        .at_most(4096)
        .optional();
    s.integer(&Execution::threads, "threads", "Threads of each run; 0 shares out the cores.")
        .at_least(0)
        .at_most(4096)
        .optional();
    s.number(&Execution::memory_share, "memory_share", sdk::dimension::none,
             "Share of the free memory that all runs together may take, by their estimates.")
        .above(0)
        .at_most(1)
        .optional();
    return s.build();
  }();
  return made;
}

const sdk::ParameterSchema& SlurmSpec::schema() {
  static const sdk::ParameterSchema made = [] {
    SchemaOf<SlurmSpec> s;
    s.text(&SlurmSpec::partition, "partition", "Partition of the cluster.").optional();
    s.text(&SlurmSpec::account, "account", "Account that is charged.").optional();
    s.text(&SlurmSpec::time_limit, "time_limit",
           "Longest wall time of a point as sbatch takes it, e.g. 08:00:00; a point that is cut "
           "off goes on from its checkpoint.")
        .optional();
    s.integer(&SlurmSpec::at_a_time, "at_a_time", "Points at a time; 0 leaves it to the cluster.")
        .at_least(0)
        .optional();
    s.integer(&SlurmSpec::attempts, "attempts", "How often a point is submitted until it ends.")
        .at_least(1)
        .at_most(100)
        .optional();
    s.integer(
         &SlurmSpec::points_per_job, "points_per_job",
         "Points that one job runs side by side, for clusters that give whole nodes; cores and "
         "memory asked for are those of all.")
        .at_least(1)
        .at_most(1000)
        .optional();
    s.texts(&SlurmSpec::options, "options", "More options of sbatch, e.g. [--qos=long].")
        .optional();
    s.texts(&SlurmSpec::prologue, "prologue",
            "Lines of shell before the runs of a job, e.g. [module load hdf5].")
        .optional();
    return s.build();
  }();
  return made;
}

const sdk::ParameterSchema& CalibrationSpec::schema() {
  static const sdk::ParameterSchema made = [] {
    SchemaOf<CalibrationSpec> s;
    s.text(&CalibrationSpec::surrogate, "surrogate", "What stands in for the runs between points.")
        .one_of({"gaussian_process", "quadratic"})
        .optional();
    s.integer(&CalibrationSpec::runs, "runs", "Most points that are run.")
        .at_least(4)
        .at_most(1000)
        .optional();
    s.integer(&CalibrationSpec::first_runs, "first_runs",
              "Points spread over the ranges before the search begins; 0 takes 5 per parameter.")
        .at_least(0)
        .at_most(1000)
        .optional();
    s.integer(&CalibrationSpec::batch, "batch", "Points chosen at a time.")
        .at_least(1)
        .at_most(100)
        .optional();
    s.number(&CalibrationSpec::confidence, "confidence", sdk::dimension::none,
             "Probability that the confidence region holds the parameters.")
        .above(0)
        .below(1)
        .optional();
    return s.build();
  }();
  return made;
}

}  // namespace dust::study
