"""A sweep on a Dask cluster of several processes, one of which is killed."""

import os
import pathlib
import pickle
import signal

import linkproof
import linkproof.dask
import pytest
from distributed import Client, LocalCluster
from test_sweep import FIGURES, VARY, figures_of

#: The range of motion takes more than a millisecond a case, so that a worker can be killed within a share.
GIVEN = {"vary": VARY, "figures": [*FIGURES, "reach_from"], "sobol": 3000, "part": 50}


@pytest.fixture(scope="module")
def client():
    with LocalCluster(n_workers=3, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        yield client


@pytest.fixture(scope="module")
def four_bar():
    return linkproof.Scenario.new("four-bar")


def test_a_killed_worker_does_not_change_the_bytes(client, four_bar, tmp_path):
    pids, killed = client.run(os.getpid), []

    def kill(done, cases):
        """Kill a worker that is in the middle of a share."""
        assert 0 < done <= cases == 3000
        busy = [worker for worker, keys in client.processing().items() if keys and worker in pids]
        if done >= 500 and not killed and busy:
            killed.append(pids[busy[0]])
            os.kill(killed[0], signal.SIGKILL)

    out = tmp_path / "shared"
    found = linkproof.dask.sweep(client, four_bar, **GIVEN, out=out, shards=30, progress=kill)
    assert killed and killed[0] not in client.run(os.getpid).values()
    alone = four_bar.sweep(**GIVEN)
    assert pathlib.Path(found.path).read_bytes() == pathlib.Path(alone.path).read_bytes()
    assert client.run_on_scheduler(lambda dask_scheduler: dask_scheduler.allowed_failures) == 1000
    table = found.table()
    for case in [0, 1499, 2999]:
        solution = four_bar.set(found.setting(case)).solve()
        assert [table[figure][case] for figure in FIGURES] == figures_of(solution)
    # A complete sweep is only opened.
    again = linkproof.dask.sweep(client, four_bar, **GIVEN, out=out)
    assert again.is_complete and again.counts["stored"] == 3000


def test_a_stopped_sweep_continues(client, four_bar, tmp_path):
    given = {**GIVEN, "sobol": 400}
    # An earlier run has left some parts.
    four_bar.sweep(**given, out=tmp_path / "out", shard=(1, 3))
    found = linkproof.dask.sweep(client, four_bar, **given, out=tmp_path / "out")
    assert pathlib.Path(found.path).read_bytes() == pathlib.Path(four_bar.sweep(**given).path).read_bytes()


def test_faults_of_workers_are_told(client, four_bar, tmp_path):
    wrong = linkproof.Scenario.from_text(four_bar.text.replace("2*atan2(q + sqrt", "2*atan2(q - sqrt"))
    with pytest.raises(linkproof.NumericError, match="case 0 disagrees"):
        linkproof.dask.sweep(client, wrong, {"crank_mm": "30:40:4"}, FIGURES, prove_every=4, out=tmp_path / "wrong")
    four_bar.sweep({"crank_mm": "30:40:4"}, FIGURES, out=tmp_path / "seen", shard=(1, 1))
    with pytest.raises(linkproof.ReadError, match="does not see") as caught:
        linkproof.dask._check([str(tmp_path / "seen/parts/000000000.parquet")], "another digest", 1)
    assert caught.value.key == "out" and pickle.loads(pickle.dumps(caught.value)).help == caught.value.help
