//! A skill in motion: it is the paper's differential equation, its deviations obey the bounds of `design/method.md` section 3 for every
//! force signal, and the same inputs give the same bits.

use std::sync::OnceLock;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::learning::cpdmp::{CouplingSettings, ForceConvention, Switching};
use cpdmp::learning::dmp::{Motion, TransformationSystem, forcing_target};
use cpdmp::learning::{ExecutionSettings, LearningError, LearningSettings, Skill, SkillExecution, StepInput, generate, learn};
use cpdmp::math::{MinimumJerk, minimum_jerk, stream, uniform};

fn skill() -> &'static Skill {
    static SKILL: OnceLock<Skill> = OnceLock::new();
    SKILL.get_or_init(|| learn(&PickAndPlace::default().dataset(0), &LearningSettings::default(), 0).unwrap().skill)
}

fn settings(coupling: CouplingSettings) -> ExecutionSettings {
    ExecutionSettings { theta_m: vec![("block_height_m".to_owned(), 0.235)], coupling, ..Default::default() }
}

fn coupled(switching: Switching) -> CouplingSettings {
    CouplingSettings { enabled: true, compliance_m_per_n: vec![0.05], saturation_m: 0.08, switching, ..Default::default() }
}

#[test]
fn the_two_springs_together_are_equation_16() {
    let mut execution = SkillExecution::new(skill(), &settings(coupled(Switching::Smooth(1.0)))).unwrap();
    let theta = nalgebra::DVector::from_element(1, 0.235);
    let mut shaping = skill().motion.shaping_at(&theta).unwrap();
    let (start, goal) = skill().ends_at(&theta);
    let system = TransformationSystem::new(5000.0, execution.duration_s());
    let mut x: Vec<Motion> = start.iter().map(|x| Motion { position: *x, velocity: 0.0 }).collect();
    let (dt, mut worst) = (0.002, 0.0f64);
    for i in 0..14_000 {
        let u = f64::from(i) * dt / execution.duration_s();
        let mut wrench = execution.state().expected_wrench.clone();
        wrench[0] += 1.0 + (0.7 * f64::from(i) * dt).sin();
        let state = execution.step(&StepInput { wrench: wrench.as_slice(), ..StepInput::of(dt) });
        let mut net = [[0.0; 3]; 3];
        for (part, net) in [0.0, 0.5, 1.0].iter().zip(&mut net) {
            shaping.net_forcing(u + part * dt / 28.0, &start, &goal, net);
        }
        for j in 0..3 {
            let c = net.map(|net| goal[j] + net[j] + state.zeta[j] / 5000.0);
            x[j] = system.runge_kutta(x[j], c, dt);
            worst = worst.max((x[j].position - state.position[j]).abs()).max((x[j].velocity - state.velocity[j]).abs());
        }
    }
    assert!(worst < 1e-6, "differs by {worst}");
    assert!(execution.state().u > 0.999);
}

/// Adversaries: forces that push wherever it hurts, with delays, resonance and the wrong sign.
fn adversary(kind: usize, time: f64, past: &[(f64, f64)], random: &mut rand_chacha::ChaCha8Rng) -> f64 {
    let delayed = |seconds: f64| past.len().checked_sub(1 + (seconds * 100.0) as usize).map_or((0.0, 0.0), |i| past[i]);
    match kind {
        0 => 1e6,
        1 => 50.0 * delayed(0.0).1.signum(),
        2 => 1e4 * delayed(0.3).0,
        3 => -1e4 * delayed(0.5).0,
        4 => 40.0 * (2.5 * time).sin().signum(),
        5 => uniform(random, -1e3, 1e3),
        _ => {
            if time < 12.0 {
                -30.0
            } else {
                f64::NAN
            }
        }
    }
}

#[test]
fn no_force_signal_moves_the_hand_beyond_the_saturation_and_deviations_fade_as_fast_as_promised() {
    for (kind, switching) in (0..7).flat_map(|k| [(k, Switching::Hard), (k, Switching::Smooth(1.0))]) {
        let mut execution = SkillExecution::new(skill(), &settings(coupled(switching))).unwrap();
        let end = execution.compliance_windows()[0].end;
        let mut random = stream(kind as u64, "adversary", 0);
        let (mut past, mut largest) = (Vec::new(), 0.0f64);
        for i in 0..3100 {
            let mut wrench = execution.state().expected_wrench.clone();
            wrench[0] += adversary(kind, f64::from(i) * 0.01, &past, &mut random);
            let state = execution.step(&StepInput { wrench: wrench.as_slice(), ..StepInput::of(0.01) }).clone();
            let e = state.deviation[0];
            assert!(e.abs() <= 0.08 * (1.0 + 1e-12), "adversary {kind}: {e} m at {} s", state.time_s);
            let d = (state.u - end) * 28.0 - 0.01;
            if d > 0.0 {
                let wd = execution.omega() * d;
                let bound = 0.08 * (1.0 + (1.0 + 2.0 / std::f64::consts::E) * wd) * (-wd).exp();
                assert!(e.abs() <= bound + 1e-12, "adversary {kind}: {e} m, {d} s after the window, bound {bound}");
            }
            largest = largest.max(e.abs());
            past.push((e, state.velocity[0]));
        }
        assert!(largest > 0.01, "adversary {kind} did nothing");
        assert!((&execution.state().position - execution.goal()).norm() < 1e-4, "adversary {kind} kept the hand from the goal");
    }
}

#[test]
fn the_expected_wrench_is_the_weight_of_the_toy_while_it_is_held() {
    let mut execution = SkillExecution::new(skill(), &settings(CouplingSettings::default())).unwrap();
    for i in 0..2800 {
        let expected = execution.step(&StepInput { wrench: &[0.0; 3], ..StepInput::of(0.01) }).expected_wrench.clone();
        let held = (1450..2600).contains(&i);
        if held || i < 1200 {
            let truth = nalgebra::DVector::from_vec(vec![0.0, 0.0, if held { -1.5 } else { 0.0 }]);
            assert!((&expected - truth).norm() < 0.15, "{expected} at {} s", f64::from(i) * 0.01);
        }
    }
}

#[test]
fn waiting_keeps_the_path_and_a_push_goes_where_the_convention_says() {
    let mut fast = SkillExecution::new(skill(), &settings(CouplingSettings::default())).unwrap();
    let mut slow = fast.clone();
    for _ in 0..1400 {
        fast.step(&StepInput::of(0.01));
        slow.step(&StepInput { phase_rate: 0.5, ..StepInput::of(0.01) });
        slow.step(&StepInput { phase_rate: 0.5, ..StepInput::of(0.01) });
    }
    assert!((&fast.state().position - &slow.state().position).norm() < 1e-5);
    assert!((&fast.state().velocity * 0.5 - &slow.state().velocity).norm() < 1e-5);
    let held = slow.step(&StepInput { phase_rate: 0.0, ..StepInput::of(0.01) }).clone();
    assert_eq!((held.u, held.velocity.norm()), (slow.step(&StepInput { phase_rate: 0.0, ..StepInput::of(0.01) }).u, 0.0));
    for (convention, sign) in [(ForceConvention::OnRobot, 1.0), (ForceConvention::OnWorld, -1.0)] {
        let coupling = CouplingSettings { convention, ..coupled(Switching::Hard) };
        let mut execution = SkillExecution::new(skill(), &settings(coupling)).unwrap();
        for _ in 0..1300 {
            let mut wrench = execution.state().expected_wrench.clone();
            wrench[2] += 1.0;
            execution.step(&StepInput { wrench: wrench.as_slice(), ..StepInput::of(0.01) });
        }
        assert!((execution.state().deviation[2] - sign * 0.05).abs() < 1e-3);
    }
}

#[test]
fn a_forcing_target_is_what_the_primitive_needs_to_repeat_the_movement() {
    let (stiffness, tau, alpha, steps) = (5000.0f64, 4.0, 100f64.ln(), 4000);
    let system = TransformationSystem::new(stiffness, tau);
    let (x0, g) = (0.2, 0.7);
    let shown = |u: f64| {
        let MinimumJerk { position, velocity, acceleration } = minimum_jerk(u);
        let bump = (std::f64::consts::PI * u).sin().powi(4);
        [x0 + (g - x0) * position + 0.3 * bump, velocity * (g - x0) / tau, acceleration * (g - x0) / (tau * tau)].map(|v| v)
    };
    // Differentiate the bump numerically: the law is about the inversion, not about this movement.
    let motion = |u: f64| {
        let h = 1e-4;
        let (a, b, c) = (shown(u - h)[0], shown(u)[0], shown(u + h)[0]);
        [b, (c - a) / (2.0 * h * tau), (c - 2.0 * b + a) / (h * tau).powi(2)]
    };
    let x_eq = |u: f64| {
        let s = (-alpha * u).exp();
        g + forcing_target(motion(u), x0, g, s, system.omega()) - (g - x0) * s
    };
    let (mut m, dt, mut worst) = (Motion { position: x0, velocity: 0.0 }, tau / f64::from(steps), 0.0f64);
    for i in 0..steps {
        let u = |part: f64| (f64::from(i) + part) / f64::from(steps);
        m = system.runge_kutta(m, [x_eq(u(0.0)), x_eq(u(0.5)), x_eq(u(1.0))], dt);
        worst = worst.max((m.position - shown(u(1.0))[0]).abs());
    }
    assert!(worst < 1e-6, "off by {worst} m");
}

/// The text as another program would write it, which knows of no checksum.
fn without_checksum(text: &str) -> String {
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim_start().starts_with("\"checksum\"")).collect();
    assert_eq!(lines.len() + 1, text.lines().count(), "there is one checksum");
    lines.join("\n")
}

#[test]
fn a_skill_file_comes_back_bit_for_bit_and_moves_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("skill.json");
    skill().write(&path).unwrap();
    let back = Skill::read(&path).unwrap();
    assert!(&back == skill(), "the skill changed on the way");
    let [a, b] = [skill(), &back].map(|s| generate(s, &settings(CouplingSettings::default()), 0.05, 1.0).unwrap());
    assert!(a == b);
    let text = std::fs::read_to_string(&path).unwrap();
    let more = text.replacen('{', "{\"note\": \"edited\",", 1);
    assert!(Skill::from_json(&more).unwrap_err().to_string().contains("remove that key"), "an edited file is not taken for ours");
    let with_more = without_checksum(&text).replacen('{', "{\"note\": \"other programs may add keys\",", 1);
    assert!(&Skill::from_json(&with_more).unwrap() == skill());
}

#[test]
fn damaged_and_newer_skill_files_are_refused_with_the_place() {
    let text = without_checksum(&skill().to_json().unwrap());
    let message = |text: &str| match Skill::from_json(text) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("accepted"),
    };
    assert!(message(&text[..text.len() / 2]).contains("line"));
    assert!(message(&text.replacen("\"version\": 1", "\"version\": 2", 1)).contains("newer"));
    assert!(message(&text.replacen("cpdmp-skill", "other", 1)).contains("format"));
    assert!(message(&text.replacen("\"stiffness\": 5000.0", "\"stiffness\": -1.0", 1)).contains("stiffness"));
    assert!(message(&text.replacen("\"z_m\"", "\"z_m\", \"more_m\"", 1)).contains("expected 4"));
    let mut flat = skill().clone();
    if let cpdmp::learning::cpdmp::Shaping::Phmm(phmm) = &mut flat.motion.shaping {
        phmm.covariances[3].fill(1.0);
    }
    assert!(flat.to_json().unwrap_err().to_string().contains("state 3"));
}

#[test]
fn threads_change_nothing_and_seeds_are_the_only_chance() {
    let settings = LearningSettings { rate_hz: 10.0, ..Default::default() };
    let json = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| learn(&PickAndPlace::default().dataset(1), &settings, seed).unwrap().skill.to_json().unwrap())
    };
    assert!(json(1, 7) == json(3, 7));
}

#[test]
fn requests_that_make_no_sense_are_refused_by_name() {
    let ask = |change: fn(&mut ExecutionSettings)| {
        let mut asked = settings(coupled(Switching::Hard));
        change(&mut asked);
        match SkillExecution::new(skill(), &asked) {
            Err(LearningError::Request(message)) => message,
            Err(LearningError::Settings(faults)) => faults[0].to_string(),
            other => panic!("{other:?}"),
        }
    };
    assert!(ask(|a| a.theta_m.clear()).contains("block_height_m is missing"));
    assert!(ask(|a| a.theta_m.push(("width_m".to_owned(), 1.0))).contains("unknown parameter width_m"));
    assert!(ask(|a| a.theta_m[0].1 = f64::NAN).contains("finite"));
    assert!(ask(|a| a.goal = Some(vec![1.0])).contains("goal"));
    assert!(ask(|a| a.duration_s = Some(0.0)).contains("duration"));
    assert!(ask(|a| a.coupling.compliance_m_per_n = vec![0.1, 0.1]).contains("2 compliances"));
    assert!(ask(|a| a.coupling.saturation_m = f64::NAN).contains("saturation"));
    let mut execution = SkillExecution::new(skill(), &settings(coupled(Switching::Hard))).unwrap();
    let state = execution.step(&StepInput { wrench: &[f64::INFINITY], phase_rate: f64::NAN, ..StepInput::of(f64::NAN) }).clone();
    assert!(!state.wrench_valid && state.position.iter().chain(state.velocity.iter()).all(|x| x.is_finite()));
}
