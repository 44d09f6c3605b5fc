"""The page's pictures as matplotlib figures. The functions return figures and do not show them. Values have their
metric's unit; shares and scores are in per cent, as on the page. Intervals, estimates and budgets come from the
summary."""
import statistics
import sys

from etude.program import EtudeError, needed
from etude.results import Pairs
from etude.tables import condition_text

Figure = needed("matplotlib.figure").Figure
# The colours of the report page, in the page's order.
COLOURS = ("#41464b", "#1ea194", "#9c5201", "#8b19e6", "#316f93", "#ae8f16", "#470014", "#02175b")
DASHES = ("-", "-", "-", "-", "--", "--", ":", ":")
BAND, QUIET = "#e4e2da", "#8a8a86"
SWARM = 0.18


def estimation(pairs, **named):
    """Returns the estimation plot of two methods (Gardner & Altman 1986). The left side joins the values of the two
    methods in each world. The right side has the paired differences with the summary's intervals over worlds and over
    clips, and a band for differences that do not matter.

    pairs: from Run.pairs; or a Run, followed by the arguments of Run.pairs: estimation(run, method="a", baseline="b").
    A pair that the summary does not compare has no interval.
    """
    if not isinstance(pairs, Pairs):
        pairs = pairs.pairs(**named)
    if not len(pairs):
        raise EtudeError(f"no world has values of both '{pairs.method_name}' and '{pairs.baseline_name}'")
    figure = Figure(figsize=(8, 3.6), layout="constrained")
    values, differences = figure.subplots(1, 2)
    # Dots are coloured by sampling unit, or by method if every world is its own unit.
    names = sorted({unit for unit in pairs.units if unit is not None})
    colours = [_colour(names.index(unit)) if unit is not None else None for unit in pairs.units]
    baseline, method = (_shown_values(of, pairs.metric) for of in (pairs.baseline, pairs.method))
    left, right = ([place + offset for offset in _aside(of)] for place, of in ((0, baseline), (1, method)))
    values.plot([left, right], [baseline, method], color=QUIET, linewidth=0.5, alpha=0.5, zorder=1)
    for x, y, own in ((left, baseline, 0), (right, method, 1)):
        values.scatter(x, y, s=14, c=[colour or _colour(own) for colour in colours], zorder=2)
    values.set_xticks([0, 1], [pairs.baseline_name, pairs.method_name])
    values.set_xlim(-0.5, 1.5)
    values.set_ylabel(_label(pairs.metric))
    _differences(differences, pairs, names, colours)
    # The title gives the condition, if there is one, and the verdicts on these worlds and on other worlds.
    condition = pairs.condition[0] if len(set(pairs.condition)) == 1 and pairs.condition[0] != "-" else ""
    says = f": {pairs.verdict.verdict} on these worlds" if pairs.verdict else ""
    beyond = f", {pairs.verdict.beyond} for others" if pairs.verdict and pairs.verdict.beyond else ""
    figure.suptitle(f"“{pairs.method_name}” against “{pairs.baseline_name}”{', ' if condition else ''}{condition}"
                    f"{says}{beyond}", fontsize="medium")
    return _shown(figure)


def _differences(axes, pairs, names, colours):
    scale = _scale(pairs.metric)
    matters = scale * pairs.metric.practical_threshold if pairs.metric else 0
    shown = _shown_values(pairs.difference, pairs.metric)
    axes.axhspan(-matters, matters, color=BAND, zorder=0)
    axes.axhline(0, color=QUIET, linewidth=0.8, zorder=1)
    axes.scatter(_aside(shown), shown, s=14, c=[colour or _colour(1) for colour in colours], zorder=2)
    ticks, labels = [0], ["each world"]
    told = pairs.verdict.details if pairs.verdict else None
    if told and told["difference"] is not None:
        by_mean = pairs.metric is not None and pairs.metric.aggregate == "mean"
        _interval(axes, 1, told["difference"], told["ci95_low"], told["ci95_high"], scale)
        ticks.append(1)
        labels.append("their mean" if by_mean else "their median")
        beyond = told.get("beyond") or {}
        if names and beyond.get("difference") is not None:
            for i, name in enumerate(names):
                of_unit = [value for value, unit in zip(shown, pairs.units) if unit == name]
                axes.scatter([2], [sum(of_unit) / len(of_unit)], s=26, color=_colour(i), zorder=2)
            _interval(axes, 2.25, beyond["difference"], beyond["ci95_low"], beyond["ci95_high"], scale)
            ticks.append(2)
            labels.append("middle, units")
    axes.set_xticks(ticks, labels)
    axes.set_xlim(-0.5, ticks[-1] + 0.5)
    unit = "percentage points" if scale != 1 else pairs.unit
    axes.set_ylabel(f"{pairs.method_name} minus {pairs.baseline_name}" + (f", {unit}" if unit else ""))


def curves(run, name, *, scenario=None, condition=None):
    """Returns one curve per method: at each step, the median over the method's cells. A cell that has ended keeps its
    last value, as on the report's page. name: the name of a series, such as "position_error_max_cm"."""
    scenario = run._named(scenario)
    found, axis, unit = {}, "", ""
    for each in run.series(name, scenario=scenario, condition=condition):
        if len(each):
            found.setdefault(each.method, []).append(each.values)
            axis, unit = each.axis, each.unit
    if not found:
        raise EtudeError(f"{scenario}: no cell has the curve '{name}'")
    figure = Figure(figsize=(8, 3.6), layout="constrained")
    axes = figure.subplots()
    drawn = []
    for i, method in enumerate(run.methods(scenario)):
        if method in found:
            median = _shown_values(median_curve(found[method]), run.metrics.get(name))
            drawn += median
            axes.plot(median, DASHES[i % len(DASHES)], color=_colour(i), label=method)
    if min(drawn) > 0 and max(drawn) / min(drawn) > 100:
        axes.set_yscale("log")
    axes.set_xlabel(axis)
    axes.set_ylabel(_label(run.metrics[name]) if name in run.metrics else f"{name} ({unit})" if unit else name)
    axes.set_title(f"{scenario}: median{'' if condition in (None, '-') else ', ' + condition}", fontsize="medium")
    axes.legend(fontsize="small", frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    return _shown(figure)


def median_curve(several):
    """Returns the median at every step. A curve that has ended keeps its last value."""
    longest = max(len(each) for each in several)
    return [statistics.median(float(each[min(step, len(each) - 1)]) for each in several) for step in range(longest)]


def error_budget(run, *, scenario=None, condition=None, method=None):
    """Returns a waterfall of the errors that the stages cause, with the summary's intervals. The waterfall starts at a
    method's error and ends at the error that remains when the truth replaces all stages."""
    wanted = [scenario] if scenario is not None else run.scenarios
    for each in run.summary["scenarios"]:
        for of in each["conditions"] if each["name"] in wanted else ():
            for budget in of.get("error_budgets", ()):
                if condition in (None, condition_text(of["condition"])) and method in (None, budget["method"]):
                    return _waterfall(budget, run.metrics.get(budget["metric"]))
    raise EtudeError("there is no error budget; an error budget needs methods that differ only in the key `oracle`")


def _waterfall(budget, metric):
    figure = Figure(figsize=(6, 0.4 * (len(budget["shares"]) + 2) + 1), layout="constrained")
    axes = figure.subplots()
    scale = _scale(metric)
    left, bars = scale * budget["total"], [(budget["method"], 0, scale * budget["total"], None)]
    for share in budget["shares"]:
        bars.append((share["stage"], left, left - scale * share["mean"], share))
        left -= scale * share["mean"]
    bars.append(("remaining error", 0, scale * budget["rest"], None))
    for i, (_, begin, end, share) in enumerate(bars):
        colour = _colour(0 if share is None else 2 if end > begin else 1)
        axes.barh(i, end - begin, left=begin, height=0.5, color=colour)
        if share and share["mean_ci95_low"] is not None:
            ends = [begin - scale * share[bound] for bound in ("mean_ci95_low", "mean_ci95_high")]
            axes.plot(ends, [i, i], color="black", linewidth=1.5)
    axes.set_yticks(range(len(bars)), [bar[0] for bar in bars])
    axes.invert_yaxis()
    axes.set_xlabel(_label(metric))
    axes.set_title(f"“{budget['method']}”: mean of {budget['worlds']} worlds", fontsize="medium")
    return _shown(figure)


def _colour(i):
    return COLOURS[i % len(COLOURS)]


def _label(metric):
    if metric is None:
        return ""
    better = {"lower": "\nlower is better", "higher": "\nhigher is better"}.get(metric.direction, "")
    unit = "%" if _scale(metric) != 1 else metric.unit
    return f"{metric.label}{', ' + unit if unit else ''}{better}"


def _scale(metric):
    """Returns 100 if the page shows the metric in per cent, else 1."""
    return 1 if metric is None or metric.reads == "amount" else 100


def _shown_values(values, metric):
    return [_scale(metric) * value for value in values]


def _interval(axes, x, estimate, low, high, scale):
    estimate, low, high = (value if value is None else scale * value for value in (estimate, low, high))
    if low is not None and high is not None:
        axes.plot([x, x], [low, high], color="black", linewidth=2, zorder=3, gid="interval")
    axes.plot([x], [estimate], "o", color="black", markersize=6, zorder=3, gid="estimate")


def _aside(values):
    """Returns how far dots are moved aside, so that equal values do not hide each other."""
    low, high = min(values), max(values)
    bins = {}
    for i, value in enumerate(values):
        bins.setdefault(round(40 * (value - low) / (high - low)) if high > low else 0, []).append(i)
    offsets = [0.0] * len(values)
    most = max(map(len, bins.values()))
    for places in bins.values():
        for k, i in enumerate(places):
            offsets[i] = 2 * SWARM * (k - (len(places) - 1) / 2) / max(most - 1, 6)
    return offsets


def _shown(figure):
    """Returns the figure. A notebook shows the figure if it is the value of a notebook's cell."""
    if "IPython" in sys.modules:
        from IPython import get_ipython
        if get_ipython() is not None:
            from IPython.core.pylabtools import select_figure_formats
            select_figure_formats(get_ipython(), {"png"})
    return figure
