"""A table of every figure of every sensor of some runs, with one standard error."""


def figure_text(figure):
    value = figure["value"]
    if value is None:
        return "-"
    error = figure.get("uncertainty")
    return f"{value:.5g}" + (f" ± {error:.2g}" if error is not None else "") + f" {figure['unit']}"


def lines(runs):
    """`runs`: (label, run) pairs; those that are not finished are left out."""
    done = [(label, run.summary["sensors"]) for label, run in runs if run.is_finished()]
    if not done:
        return []
    names = dict.fromkeys((sensor, figure) for _, sensors in done for sensor, figures in sensors.items() for figure in figures)
    out = ["## All figures (± one standard error)", "", "| figure | " + " | ".join(label for label, _ in done) + " |",
           "| --- |" + " --- |" * len(done)]
    for sensor, name in names:
        found = [sensors.get(sensor, {}).get(name) for _, sensors in done]
        out.append(f"| {sensor}/{name} | " + " | ".join(figure_text(f) if f else "-" for f in found) + " |")
    return [*out, ""]
