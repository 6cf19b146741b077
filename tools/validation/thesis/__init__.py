"""Every number and sign of chapters 3 to 6 of the thesis: one file a chapter, each with rows(runs)."""
