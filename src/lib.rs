//! `cpdmp`: a physics testbed for **Compliant Parametric Dynamic Movement Primitives** (Ugur & Girgin, *Robotica* 38(3), 2020).
//!
//! A person teaches a simulated Baxter by leading its weightless arm. The demonstrations become a movement primitive whose forcing term is a
//! parametric hidden Markov model: it bends with the task (the height of a block), expects forces, and yields where the teachers disagreed.
//!
//! # The equations
//! Numbers are the paper's; the code cites them where it computes them.
//!
//! | what | equation | room |
//! |---|---|---|
//! | DMP | `tau vdot = K(g-x) - D v - K(g-x0) s + K f(s)`, `tau xdot = v`, `tau sdot = -alpha s` (1)–(3) | [`learning::dmp`] |
//! | forcing target of a demonstration | `f = -(g-x) + (g-x0) s + (tau vdot + D v)/K` (4) | [`learning::dmp`] |
//! | LWR, the baseline | `f(s) = s sum w psi / sum psi` (5)–(10) | [`learning::dmp`] |
//! | CPDMP | the DMP with `K f(theta_m, s) + zeta(theta_f, s)` (11), (16) | [`learning::cpdmp`] |
//! | parametric HMM | state means `mu_i(theta) = W_i theta + mean_i` (12) | [`learning::phmm`] |
//! | Gaussian mixture regression | phase in, forcing out (13)–(15) | [`learning::Gmr`] |
//! | coupling | `zeta = beta K1 J^T K2 (F - F_des(theta_f, s))` (17)–(19) | [`learning::cpdmp`] |
//! | compliance | `beta_i = -1` where the demonstrations disagree (20) | [`learning::cpdmp`] |
//!
//! # The flow
//! ```text
//! scenarios/*.toml -> Scenario -> World ------------------+
//! demonstrations -> Skill (CPDMP) -> Controller ----------+-> step loop -> StepRecord* -> recording, checks -> report
//! ```
//!
//! # The rows
//! A room imports only rooms on lower rows; rooms on one row do not know each other. `tests/architecture.rs` holds this.
//!
//! | row | rooms | |
//! |---|---|---|
//! | 9 | [`cli`] | the terminal |
//! | 8 | [`batch`] | many runs |
//! | 7 | [`scenario`], [`report`] | text in, text out |
//! | 6 | [`check`], [`recording`], [`figure`] | readers of what a run left behind |
//! | 5 | [`simulation`] | teach, replay, execute: the only room that knows both world and control |
//! | 4 | [`world`], [`control`], [`planar`] | physics; decisions; the paper's experiments without an arm |
//! | 3 | [`learning`], [`robot`] | what was learned; what the arm is |
//! | 2 | [`demonstration`] | what a person showed |
//! | 1 | [`math`], [`palette`] | numbers; colours |
//!
//! # Notation
//! Inside functions equations use the paper's symbols as ASCII names (`tau, alpha, s, g, x0, f, zeta`); fields and arguments use words.
//! `a_from_b` maps coordinates in frame b to coordinates in frame a. Quaternions are scalar last in files and columns. SI everywhere; names of
//! keys and columns carry their unit. `u = t / tau` is the elapsed fraction of the duration, `s = exp(-alpha u)` the phase.
//!
//! # What the paper leaves open
//! How it is closed, in short; each option's documentation says what was measured: several starts of EM, the best parametric likelihood wins;
//! per-state centred regression instead of a plain inverse; no `W` on the phase row; net forcing gated to zero at the end, so that the goal is
//! reached; compliance by the covariance *between* demonstrations; the coupling as a compliance in m/N, saturated, and faded over `1/omega`.

pub mod batch;
pub mod check;
pub mod cli;
pub mod control;
pub mod demonstration;
pub mod figure;
pub mod learning;
pub mod math;
pub mod palette;
pub mod planar;
pub mod recording;
pub mod report;
pub mod robot;
pub mod scenario;
pub mod simulation;
pub mod world;
