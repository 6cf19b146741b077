"""Times of a run by the groups that its summary.json names: nobody else knows the timers' names."""


def of_particles(summary):
    """Seconds that the particles cost by themselves: neighbours, contacts, motion, the fine level."""
    return sum(summary["timers_s"][name] for name in summary["timer_groups"]["particles"])


def nested(summary):
    """Names of timers that are part of another, `dem_cycle`."""
    return set(summary["timer_groups"]["dem_cycle"])
