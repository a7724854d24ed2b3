"""What a recording says without its prior, of a problem whose data alone are known."""

import numpy as np

from equipoise.estimation.information.single_record_information import data_alone
from equipoise.estimation.parameters.fit_parameters import CORE


def test_a_prior_leaves_no_trace_in_what_the_data_say():
    """A linear problem of 15 unknowns: data D y = d alone, and with a prior far off on the core.

    The optimum with the prior is (D + W)^-1 (d + W m). From it come back the data's own information
    on the core, (D^-1)_cc^-1, and their own optimum y, whatever the prior was.
    """
    rng = np.random.default_rng(3)
    rows = rng.normal(size=(40, 15))
    data, y = rows.T @ rows, rng.normal(size=15)
    core = np.arange(15)[CORE]
    weight, mean = rng.uniform(5.0, 50.0, len(core)), rng.normal(3.0, 1.0, len(core))
    whole, pull = data.copy(), data @ y
    whole[core, core] += weight
    pull[core] += weight * mean
    x = np.linalg.solve(whole, pull)
    assert np.linalg.norm(x[core] - y[core]) > 1.0
    information, eta = data_alone(whole, x[core], weight, mean)
    alone = np.linalg.inv(np.linalg.inv(data)[np.ix_(core, core)])
    np.testing.assert_allclose(information, alone, rtol=0, atol=1e-9)
    np.testing.assert_allclose(np.linalg.solve(information, eta), y[core], rtol=0, atol=1e-9)
