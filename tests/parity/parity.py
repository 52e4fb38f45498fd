#!/usr/bin/env python3
"""Compares `cpdmp` with independent libraries, through its commands and files alone.

    python3 -m venv /tmp/parity && /tmp/parity/bin/pip install numpy scipy hmmlearn==0.3.3 dynamax==1.0.3 gmr==2.0.3
    cargo build --release && /tmp/parity/bin/python tests/parity/parity.py

What is compared, and how closely it must agree:

    hidden Markov model     hmmlearn, same start, 20 iterations: log-likelihood and parameters          1e-8
    parametric model        dynamax LinearRegressionHMM, same start, 20 iterations: the same            1e-8
    mixture regression      gmr: the expected wrench along the movement                                 1e-10
    movement primitive      equations 1-3 by DOP853 at 1e-13: the error falls with the integrator's order
    baseline                equations 5-10 in numpy: weights and roll-out

Every line prints the largest difference that was found. The exit code is 1 when one is too large.
"""
import argparse
import csv
import json
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np

RATE_HZ = 25.0  # the rate at which models see demonstrations by default: nothing is resampled
WRENCH = ["fx_n", "fy_n", "fz_n"]
# What dynamax needs on top of a flat prior, or its mode is not defined where a count underflows (counts are of the order of 1).
NOTHING = 1e-12
FAILED = []


def report(what, found, limit):
    ok = bool(found <= limit)
    print(f"  {what:<58} {found:9.2e}   limit {limit:.0e}   {'ok' if ok else 'FAILED'}")
    if not ok:
        FAILED.append(what)


class Program:
    def __init__(self, path):
        self.path = str(Path(path).resolve())

    def __call__(self, *arguments):
        done = subprocess.run([self.path, *map(str, arguments)], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"cpdmp {' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
        return done.stdout


# -- data ---------------------------------------------------------------------------------------------------------------------------


def write_dataset(folder, sequences, thetas):
    """Sequences of (T x 1 motion, T x 3 wrench) with one force parameter each (or none)."""
    folder.mkdir()
    lines = ["schema_version = 1", 'motion = ["x_m"]', f"wrench = {json.dumps(WRENCH)}"]
    for k, (motion, wrench) in enumerate(sequences):
        with open(folder / f"d{k}.csv", "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["time_s", "x_m", *WRENCH])
            for t in range(len(motion)):
                writer.writerow([repr(t / RATE_HZ), repr(float(motion[t])), *(repr(float(f)) for f in wrench[t])])
        theta_f = "{}" if thetas is None else f"{{ weight_n = {thetas[k]!r} }}"
        lines += ["[[demonstration]]", f'file = "d{k}.csv"', f"theta_f = {theta_f}"]
    (folder / "dataset.toml").write_text("\n".join(lines) + "\n")


def minimum_jerk(samples):
    u = np.linspace(0.0, 1.0, samples)
    return u**3 * (10 - 15 * u + 6 * u * u)


def hidden_markov_data(random, lengths, thetas, states=4):
    """Wrenches from a planted model, in user units of very different size; and what the model sees: [u, wrench]."""
    scale = np.array([1.0, 0.01, 50.0])
    means, slopes = random.normal(size=(states, 3)) * 3, random.normal(size=(states, 3))
    factors = random.normal(size=(states, 3, 3)) * 0.4 + np.eye(3)
    sequences, seen = [], []
    for k, length in enumerate(lengths):
        state, wrench = random.integers(states), np.zeros((length, 3))
        for t in range(length):
            theta = 0.0 if thetas is None else thetas[k]
            wrench[t] = (means[state] + slopes[state] * theta + factors[state] @ random.normal(size=3)) * scale
            state = random.integers(states) if random.random() < 0.15 else state
        sequences.append((minimum_jerk(length), wrench))
        seen.append(np.column_stack([np.arange(length) / (length - 1), wrench]))
    return sequences, seen


def start_model(random, seen, states, parameters):
    """A start of expectation maximisation that favours nobody."""
    everything = np.vstack(seen)
    spread = everything.std(axis=0)
    covariances = []
    for _ in range(states):
        factor = np.eye(4) + 0.3 * random.normal(size=(4, 4))
        covariances.append(np.outer(spread, spread) * (factor @ factor.T))
    draw = lambda *shape: random.dirichlet(np.full(states, 3.0), size=shape or None)
    weights = 0.1 * spread[None, :, None] * random.normal(size=(states, 4, parameters))
    return {
        "initial": draw(),
        "transition": draw(states),
        "weights": weights,
        "means": everything[random.choice(len(everything), states, replace=False)],
        "covariances": np.array(covariances),
    }


def learn_from(cpdmp, folder, dataset, start, iterations):
    """The force model after exactly so many iterations of plain maximum likelihood from `start`."""
    template, init, out = folder / "template.json", folder / "init.json", folder / "out.json"
    states = len(start["initial"])
    cpdmp("learn", dataset, "--out", template, "--states", 3, "--force-states", states, "--max-iterations", 1)
    skill = json.loads(template.read_text())
    skill.pop("checksum", None)
    keys = ["initial", "transition", "weights", "means", "covariances"]
    skill["force"]["phmm"] = {key: np.asarray(start[key]).tolist() for key in keys} | {"log_likelihood": []}
    init.write_text(json.dumps(skill))
    plain = ["ridge=0", "covariance_floor=0", "weights_on_phase=true", "topology=ergodic"]
    overrides = [argument for key in plain for argument in ("--set", f"force.{key}")]
    cpdmp("learn", dataset, "--out", out, "--init", init, "--max-iterations", iterations, "--tolerance", 0, *overrides)
    found = json.loads(out.read_text())["force"]["phmm"]
    return {key: np.array(found[key]) for key in [*keys, "log_likelihood"]}


def relative(a, b):
    return float(np.max(np.abs(np.asarray(a) - np.asarray(b))) / max(1e-300, np.max(np.abs(b))))


def per_column(a, b, scale):
    """Largest difference in units of each column's standard deviation."""
    return float(np.max(np.abs(np.asarray(a) - np.asarray(b)) / scale))


# -- comparisons --------------------------------------------------------------------------------------------------------------------


def compare_hmmlearn(cpdmp, folder, seed):
    from hmmlearn.hmm import GaussianHMM

    random = np.random.default_rng(seed)
    sequences, seen = hidden_markov_data(random, [61, 90, 75, 110, 68, 83], None)
    write_dataset(folder / "data", sequences, None)
    start = start_model(random, seen, 4, 0)
    ours = learn_from(cpdmp, folder, folder / "data", start, 20)
    theirs = GaussianHMM(4, covariance_type="full", n_iter=20, tol=-np.inf, init_params="", params="stmc", implementation="log",
                         covars_prior=0, covars_weight=0, min_covar=0, means_prior=0, means_weight=0, startprob_prior=1, transmat_prior=1)
    theirs.startprob_, theirs.transmat_ = start["initial"], start["transition"]
    theirs.means_, theirs.covars_ = start["means"], start["covariances"]
    everything, lengths = np.vstack(seen), [len(s) for s in seen]
    theirs.fit(everything, lengths)
    history = [*theirs.monitor_.history, theirs.score(everything, lengths)]
    spread = everything.std(axis=0)
    report("log-likelihood of 20 iterations (relative)", relative(ours["log_likelihood"], history), 1e-8)
    report("initial and transition probabilities", max(relative(ours["initial"], theirs.startprob_),
                                                       relative(ours["transition"], theirs.transmat_)), 1e-8)
    report("means (in standard deviations)", per_column(ours["means"], theirs.means_, spread), 1e-8)
    report("covariances (in squared standard deviations)", per_column(ours["covariances"], theirs.covars_, np.outer(spread, spread)), 1e-8)


def compare_dynamax(cpdmp, folder, seed):
    import jax

    jax.config.update("jax_enable_x64", True)
    import jax.numpy as jnp
    from dynamax.hidden_markov_model import LinearRegressionHMM

    random = np.random.default_rng(seed + 100)
    thetas = [float(x) for x in np.linspace(-1.2, 1.5, 8) + 0.1 * random.normal(size=8)]
    sequences, seen = hidden_markov_data(random, [80] * 8, thetas)
    write_dataset(folder / "data", sequences, thetas)
    start = start_model(random, seen, 4, 1)
    ours = learn_from(cpdmp, folder, folder / "data", start, 20)
    model = LinearRegressionHMM(4, 1, 4, initial_probs_concentration=1.0 + NOTHING, transition_matrix_concentration=1.0 + NOTHING)
    parameters, properties = model.initialize(
        jax.random.PRNGKey(0), initial_probs=jnp.array(start["initial"]), transition_matrix=jnp.array(start["transition"]),
        emission_weights=jnp.array(start["weights"]), emission_biases=jnp.array(start["means"]),
        emission_covariances=jnp.array(start["covariances"]))
    emissions = jnp.array(np.stack(seen))
    inputs = jnp.array(np.stack([np.full((80, 1), theta) for theta in thetas]))
    # fit_em adds a log prior to what it reports (a constant here); the data's own likelihood is asked for after the last iteration.
    parameters, _ = model.fit_em(parameters, properties, emissions, inputs=inputs, num_iters=20, verbose=False)
    final = float(sum(model.marginal_log_prob(parameters, e, u) for e, u in zip(emissions, inputs)))
    spread = np.vstack(seen).std(axis=0)
    report("log-likelihood after 20 iterations (relative)", relative(ours["log_likelihood"][-1:], [final]), 1e-8)
    report("initial and transition probabilities", max(relative(ours["initial"], parameters.initial.probs),
                                                       relative(ours["transition"], parameters.transitions.transition_matrix)), 1e-8)
    report("weights (in standard deviations)", per_column(ours["weights"], parameters.emissions.weights, spread[:, None]), 1e-8)
    report("means (in standard deviations)", per_column(ours["means"], parameters.emissions.biases, spread), 1e-8)
    report("covariances (in squared standard deviations)",
           per_column(ours["covariances"], parameters.emissions.covs, np.outer(spread, spread)), 1e-8)


def arm_like_dataset(folder, random):
    """Smooth two-column movements with a wrench, for everything about roll-outs."""
    sequences = []
    for k in range(4):
        u = np.linspace(0.0, 1.0, 100 + 10 * k)
        path = minimum_jerk(len(u)) * 0.4 + 0.05 * np.sin(np.pi * u) ** 2 * (1 + 0.1 * random.normal())
        wrench = np.column_stack([np.sin(4 * u + j) * (j + 1) for j in range(3)]) + 0.05 * random.normal(size=(len(u), 3))
        sequences.append((path, wrench))
    write_dataset(folder / "data", sequences, None)
    return folder / "data"


def generated(cpdmp, skill, folder, *arguments):
    out = folder / "path.csv"
    cpdmp("generate", skill, "--out", out, *arguments)
    rows = list(csv.reader(open(out)))
    return rows[0], np.array([[float(x) for x in row] for row in rows[1:]])


def compare_gmr(cpdmp, folder, seed):
    import gmr

    data = arm_like_dataset(folder, np.random.default_rng(seed + 200))
    skill = folder / "skill.json"
    cpdmp("learn", data, "--out", skill, "--states", 8, "--force-states", 8)
    content = json.loads(skill.read_text())
    model, duration = content["force"]["phmm"], content["motion"]["duration_s"]
    header, path = generated(cpdmp, skill, folder, "--expected-wrench", "--dt", duration / 500)
    columns = [header.index(name) if name in header else header.index(f"expected_{name}") for name in WRENCH]
    mixture = gmr.GMM(n_components=8, priors=np.full(8, 1 / 8), means=np.array(model["means"]), covariances=np.array(model["covariances"]))
    expected = mixture.predict([0], np.clip(path[:, :1] / duration, 0.0, 1.0))
    report("expected wrench at 501 phases (N)", float(np.max(np.abs(path[:, columns] - expected))), 1e-10)


def net_forcing(content):
    """`b (f - (g - x0) s)` of the motion model as a function of the time fraction, in numpy."""
    motion = content["motion"]
    alpha, start, goal = motion["alpha"], motion["start"]["mean"][0], motion["goal"]["mean"][0]
    if "lwr" in motion and motion["lwr"]:
        c, h = np.array(motion["lwr"]["centres"]), np.array(motion["lwr"]["widths"])
        w = np.array(motion["lwr"]["weights"])[:, 0]

        def lwr(u):
            s = np.exp(-alpha * u)
            psi = np.exp(-h * (s - c) ** 2)
            return s * (psi @ w) / psi.sum() - (goal - start) * s

        return lwr
    means, covariances = np.array(motion["phmm"]["means"]), np.array(motion["phmm"]["covariances"])
    gate_start = motion["gate_start"]

    def mixture(u):
        s, x = np.exp(-alpha * u), min(max(u, 0.0), 1.0)
        log_h = -0.5 * (x - means[:, 0]) ** 2 / covariances[:, 0, 0] - 0.5 * np.log(covariances[:, 0, 0])
        h = np.exp(log_h - log_h.max())
        h /= h.sum()
        f = h @ (means[:, 1] + covariances[:, 1, 0] / covariances[:, 0, 0] * (x - means[:, 0]))
        r = min(max((u - 1.0) / (gate_start - 1.0), 0.0), 1.0)
        return r**3 * (10 - 15 * r + 6 * r * r) * (f - (goal - start) * s)

    return mixture


def reference_path(content, until):
    """Equations 1-3 by a high-order method, as a function of time."""
    from scipy.integrate import solve_ivp

    motion, net = content["motion"], net_forcing(content)
    stiffness, tau = motion["stiffness"], motion["duration_s"]
    start, goal = motion["start"]["mean"][0], motion["goal"]["mean"][0]

    def slope(time, state):
        x, v = state
        return [v / tau, (stiffness * (goal - x + net(time / tau)) - 2 * np.sqrt(stiffness) * v) / tau]

    return solve_ivp(slope, [0.0, until * tau], [start, 0.0], method="DOP853", rtol=1e-13, atol=1e-14, dense_output=True, max_step=tau / 400).sol


def compare_roll_outs(cpdmp, folder, seed):
    data = arm_like_dataset(folder, np.random.default_rng(seed + 300))
    for name, flags in [("CPDMP", ["--states", 8]), ("LWR-DMP", ["--baseline"])]:
        skill = folder / f"{name}.json"
        cpdmp("learn", data, "--out", skill, *flags)
        content = json.loads(skill.read_text())
        tau = content["motion"]["duration_s"]
        truth = reference_path(content, 1.0)
        for integrator, order, steps in [("hold", 2, 1000), ("rk4", 4, 250)]:
            errors = []
            for n in (steps, 2 * steps):
                _, path = generated(cpdmp, skill, folder, "--dt", tau / n, "--integrator", integrator)
                errors.append(float(np.max(np.abs(path[:, 1] - truth(path[:, 0])[0]))))
            measured = np.log2(errors[0] / errors[1])
            print(f"    {name}, {integrator}: {errors[0]:.2e} m at {steps} steps, {errors[1]:.2e} m at {2 * steps}")
            report(f"{name}, {integrator}: order {measured:.2f}, below {order} by", max(0.0, order - measured), 0.25)


def compare_baseline(cpdmp, folder, seed):
    """The weights against numpy's least squares: by what they do, since neighbouring basis functions overlap."""
    u = np.linspace(0.0, 1.0, 301)
    path = minimum_jerk(len(u)) * 0.4 + 0.05 * np.sin(np.pi * u) ** 2
    write_dataset(folder / "data", [(path, np.zeros((len(u), 3)))], None)
    skill = folder / "skill.json"
    cpdmp("learn", folder / "data", "--out", skill, "--baseline", "--set", "lwr_basis=20")
    motion = json.loads(skill.read_text())["motion"]
    c, h, w = (np.array(motion["lwr"][key]) for key in ("centres", "widths", "weights"))
    report("centres: logarithmic in (0, 1] (relative)", relative(c, np.exp(-motion["alpha"] * np.arange(20) / 19)), 1e-12)
    report("widths: m / c^2 (relative)", relative(h, 20 / c**2), 1e-12)
    tau, alpha = motion["duration_s"], motion["alpha"]
    _, out = generated(cpdmp, skill, folder, "--dt", tau / 3000)
    report("reproduction of the demonstration (m)", float(np.max(np.abs(np.interp(u * tau, out[:, 0], out[:, 1]) - path))), 2e-3)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cpdmp", default="target/release/cpdmp", help="the program (default target/release/cpdmp)")
    parser.add_argument("--seeds", type=int, default=3, help="how many data sets (default 3)")
    arguments = parser.parse_args()
    warnings.filterwarnings("ignore")
    cpdmp = Program(arguments.cpdmp)
    comparisons = [
        ("hidden Markov model: hmmlearn", compare_hmmlearn),
        ("parametric hidden Markov model: dynamax LinearRegressionHMM", compare_dynamax),
        ("Gaussian mixture regression: gmr", compare_gmr),
        ("movement primitive: DOP853", compare_roll_outs),
        ("baseline: equations 5-10", compare_baseline),
    ]
    for title, compare in comparisons:
        for seed in range(arguments.seeds):
            print(f"{title}, data {seed}")
            with tempfile.TemporaryDirectory() as folder:
                compare(cpdmp, Path(folder), seed)
    print("\nFAILED: " + ", ".join(FAILED) if FAILED else "\nall agree")
    sys.exit(1 if FAILED else 0)


if __name__ == "__main__":
    main()
