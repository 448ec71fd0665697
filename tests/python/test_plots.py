"""gnbv.plots: figures as axes that people style on."""

import pytest

plt = pytest.importorskip("matplotlib.pyplot")
plt.switch_backend("Agg")

import gnbv  # noqa: E402
import gnbv.plots  # noqa: E402
from gnbv._program import call  # noqa: E402


def test_coverage_is_drawn_into_axes_of_ones_own_and_is_the_runs(smoke):
    figure, ax = plt.subplots()
    drawn = gnbv.plots.coverage(smoke, effort="views", ax=ax, labels={"1": "Ours"})
    assert drawn is ax
    line = next(one for one in ax.get_lines() if len(one.get_xdata()) > 2)
    assert list(line.get_ydata()) == pytest.approx(list(100 * smoke.coverage["coverage_0.05"]))
    assert line.get_drawstyle() == "steps-post"
    assert ax.get_legend().get_texts()[0].get_text() == "Ours (1 seed)"
    ax.set_xlim(0, 3)
    plt.close(figure)


@pytest.mark.parametrize("kind", ["density", "terms", "flight", "tracking"])
def test_every_kind_of_one_run_makes_its_panels(smoke, kind):
    axes = getattr(gnbv.plots, kind)(smoke)
    assert len(axes) == len(gnbv.plots.figures(smoke, [kind])[0]["panels"])
    assert all(ax.has_data() for ax in axes)
    plt.close(axes[0].figure)


def test_what_cannot_be_drawn_says_what_it_lacks(smoke):
    with pytest.raises(gnbv.BadInput, match="nothing to plot"):
        gnbv.plots.predictions(smoke)
    with pytest.raises(gnbv.BadInput, match="2 panels, not 1 axes"):
        gnbv.plots.density(smoke, axes=[plt.figure().add_subplot()])
    with pytest.raises(gnbv.BadInput, match="no such group"):
        gnbv.plots.coverage(smoke, colors={"Other": "#000000"})


def test_a_comparison_leaves_its_forest_as_data(tmp_path):
    call(
        *("compare", "smoke", "--utilities", "proposed,isler", "--seeds", "2", "--no-ceiling"),
        *("--set", "planner.termination.max_iterations=3", "--quiet"),
        *("--out", str(tmp_path / "bench"), "--plots", str(tmp_path / "plots")),
    )
    axes = gnbv.plots.forest(tmp_path / "plots" / "figures.json", "smoke")
    assert axes[0].get_xlabel().startswith("difference to Proposed")
