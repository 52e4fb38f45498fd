//! Forces bend the movement as (17)-(19) say, in task space and at the joints, under either convention of signs.

use std::sync::OnceLock;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::demonstration::{Dataset, Demonstration, Trajectory};
use cpdmp::learning::cpdmp::{CouplingMode, CouplingSettings, CouplingSpace, ForceConvention, ForceCoupling, Switching, wrench_at_tool};
use cpdmp::learning::{ExecutionSettings, LearningSettings, ShapingKind, Skill, SkillExecution, StepInput, learn};
use cpdmp::math::{minimum_jerk, stream, uniform};
use nalgebra::{DMatrix, Isometry3, Matrix6xX, Vector3, Vector6};

fn skill() -> &'static Skill {
    static SKILL: OnceLock<Skill> = OnceLock::new();
    SKILL.get_or_init(|| learn(&PickAndPlace::default().dataset(0), &LearningSettings::default(), 0).unwrap().skill)
}

fn execution(coupling: CouplingSettings) -> SkillExecution {
    let theta_m = vec![("block_height_m".to_owned(), 0.235)];
    SkillExecution::new(skill(), &ExecutionSettings { theta_m, coupling, ..Default::default() }).unwrap()
}

fn coupled(mode: CouplingMode, convention: ForceConvention) -> CouplingSettings {
    CouplingSettings { enabled: true, mode, convention, switching: Switching::Hard, ..Default::default() }
}

/// A wall of 200 N/m whose face stands where the undisturbed hand presses it with 3 N more than expected, all along the movement.
#[test]
fn beta_plus_one_lessens_the_force_error_at_a_wall_under_both_conventions() {
    const WALL: f64 = 200.0;
    let error = |coupling: CouplingSettings, sign: f64| {
        let mut execution = execution(coupling);
        let mut on_robot = 0.0;
        for _ in 0..1500 {
            // Pressed from below: the face follows the undisturbed movement 15 mm above it, and pushes down where the hand is above.
            let into = 0.015 + execution.state().deviation[2];
            on_robot = -WALL * into.max(0.0);
            let mut wrench = execution.state().expected_wrench.clone();
            wrench[2] += sign * on_robot;
            execution.step(&StepInput { wrench: wrench.as_slice(), ..StepInput::of(0.01) });
        }
        on_robot.abs()
    };
    for (convention, sign) in [(ForceConvention::OnRobot, 1.0), (ForceConvention::OnWorld, -1.0)] {
        let stiff = error(CouplingSettings { enabled: false, ..coupled(CouplingMode::Comply, convention) }, sign);
        let minimised = error(coupled(CouplingMode::MinimiseForceError, convention), sign);
        assert!((stiff - 3.0).abs() < 1e-9);
        // Steady: error / (1 + C k), C = 0.01 m/N.
        assert!((minimised - 3.0 / (1.0 + 0.01 * WALL)).abs() < 1e-3, "{convention:?}: {minimised} N");
    }
}

#[test]
fn beta_minus_one_moves_along_with_a_push_and_only_where_it_is_asked_for() {
    let states = skill().motion.states();
    for (convention, sign) in [(ForceConvention::OnRobot, 1.0), (ForceConvention::OnWorld, -1.0)] {
        for active in [0, states / 2, states - 2] {
            let mut beta = vec![0.0; states];
            beta[active] = -1.0;
            let mut execution = execution(coupled(CouplingMode::PerState(beta), convention));
            let (mut inside, mut largest) = (0.0f64, 0.0f64);
            for _ in 0..2800 {
                let mut wrench = execution.state().expected_wrench.clone();
                wrench[0] += sign * 2.0;
                let state = execution.step(&StepInput { wrench: wrench.as_slice(), ..StepInput::of(0.01) });
                assert!(state.deviation[0] >= 0.0, "never against the push");
                assert_eq!(state.activation > 0.0 && state.beta != 0.0, state.zeta[0] != 0.0);
                assert!(state.zeta[0] == 0.0 || state.state == active);
                inside += f64::from(u8::from(state.zeta[0] != 0.0));
                largest = largest.max(state.deviation[0]);
            }
            assert!(inside > 20.0 && largest > 0.002 && largest <= 0.02 + 1e-12, "state {active}: {inside} steps, {largest} m");
        }
    }
}

#[test]
fn betas_that_fit_no_state_are_refused() {
    let ask = |mode| {
        let theta_m = vec![("block_height_m".to_owned(), 0.235)];
        let coupling = coupled(mode, ForceConvention::OnRobot);
        SkillExecution::new(skill(), &ExecutionSettings { theta_m, coupling, ..Default::default() }).unwrap_err().to_string()
    };
    assert!(ask(CouplingMode::PerState(vec![1.0, 0.0])).contains("2 values for the"));
    assert!(ask(CouplingMode::PerState(vec![0.5; skill().motion.states()])).contains("coupling.beta is 0.5, but must be -1, 0 or 1"));
    let joint = CouplingSpace::Joint { compliance_rad_per_nm: vec![0.01], saturation_rad: 0.3 };
    let theta_m = vec![("block_height_m".to_owned(), 0.235)];
    let coupling = CouplingSettings { enabled: true, space: joint, ..Default::default() };
    let refused = SkillExecution::new(skill(), &ExecutionSettings { theta_m, coupling, ..Default::default() }).unwrap_err().to_string();
    assert!(refused.contains("motion [x_m, y_m, z_m]") && refused.contains("in rad"), "{refused}");
}

/// A skill without a force model expects nothing: what it is told acts as it is, what it is not told does not, and the shapes are named.
#[test]
fn without_a_force_model_the_whole_force_acts() {
    let bare = Skill { force: None, ..skill().clone() };
    let theta_m = vec![("block_height_m".to_owned(), 0.235)];
    let asked =
        ExecutionSettings { theta_m, coupling: coupled(CouplingMode::MinimiseForceError, ForceConvention::OnRobot), ..Default::default() };
    let mut pushed = SkillExecution::new(&bare, &asked).unwrap();
    assert_eq!(pushed.wrench_columns(), ["fx_n", "fy_n", "fz_n"]);
    for _ in 0..1500 {
        let state = pushed.step(&StepInput { wrench: &[2.0, 0.0, -1.0], ..StepInput::of(0.01) });
        assert!(state.wrench_valid && state.expected_wrench.amax() == 0.0);
    }
    let moved = &pushed.state().deviation - nalgebra::DVector::from_row_slice(&[0.02, 0.0, -0.01]);
    assert!(moved.norm() < 1e-6, "C F = 0.01 m/N times the force, off by {moved}");
    let message = pushed.check_input(&StepInput { wrench: &[1.0], ..StepInput::of(0.01) }).unwrap_err().to_string();
    assert!(message.contains("the wrench has 1 values, but the skill takes 3"), "{message}");
    let state = pushed.step(&StepInput { wrench: &[1.0], ..StepInput::of(0.01) });
    assert!(!state.wrench_valid && state.zeta.amax() == 0.0);
    let told = ExecutionSettings { theta_f: vec![("mass_kg".to_owned(), 1.0)], ..asked };
    assert!(SkillExecution::new(&bare, &told).unwrap_err().to_string().contains("no force model"));
}

fn names(list: &[&str]) -> Vec<String> {
    list.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn at_the_joints_forces_act_through_the_transposed_jacobian() {
    let mut random = stream(3, "jacobians", 0);
    let joints = names(&["q1_rad", "q2_rad", "q3_rad", "q4_rad"]);
    let all = ["fx_n", "fy_n", "fz_n", "tx_nm", "ty_nm", "tz_nm"];
    let c = [0.02, 0.01, 0.05, 0.03];
    for _ in 0..50 {
        let jacobian = Matrix6xX::from_fn(4, |_, _| uniform(&mut random, -1.0, 1.0));
        let [f, f_des] = [0, 1].map(|_| Vector6::from_fn(|_, _| uniform(&mut random, -5.0, 5.0)));
        for (convention, sign) in [(ForceConvention::OnRobot, 1.0), (ForceConvention::OnWorld, -1.0)] {
            let space = CouplingSpace::Joint { compliance_rad_per_nm: c.to_vec(), saturation_rad: 0.3 };
            let settings = CouplingSettings { enabled: true, convention, space, ..Default::default() };
            let law = ForceCoupling::new(&settings, &joints, &names(&all)).unwrap();
            let mut turned = [0.0; 4];
            law.displacement(0.5, (f.as_slice(), f_des.as_slice()), Some(&jacobian), &mut turned);
            let torque = jacobian.transpose() * (f - f_des);
            for j in 0..4 {
                let expected = (0.5 * sign * c[j] * torque[j]).clamp(-0.3, 0.3);
                assert!((turned[j] - expected).abs() < 1e-14);
            }
            // Columns in another order, some not measured: those count as expected.
            let partial = ForceCoupling::new(&settings, &joints, &names(&["tz_nm", "fx_n"])).unwrap();
            partial.displacement(1.0, (&[f[5], f[0]], &[f_des[5], f_des[0]]), Some(&jacobian), &mut turned);
            let only = Vector6::new(f[0] - f_des[0], 0.0, 0.0, 0.0, 0.0, f[5] - f_des[5]);
            for (j, torque) in (jacobian.transpose() * only).iter().enumerate() {
                assert!((turned[j] - (sign * c[j] * torque).clamp(-0.3, 0.3)).abs() < 1e-14);
            }
            law.displacement(1.0, (f.as_slice(), f_des.as_slice()), None, &mut turned);
            assert_eq!(turned, [0.0; 4]);
        }
    }
}

/// A joint-space skill of a planar arm of two links of 0.5 m, pushed at its tip.
#[test]
fn a_planar_arm_yields_at_its_joints_and_a_jacobian_of_another_arm_is_refused_by_shape() {
    let samples = 401;
    let values = DMatrix::from_fn(samples, 2, |t, j| 0.3 + (0.5 - 0.8 * j as f64) * minimum_jerk(t as f64 / 400.0).position);
    let times = (0..samples).map(|t| t as f64 * 0.01).collect();
    let columns = names(&["q1_rad", "q2_rad"]);
    let trajectory = Trajectory::new(times, columns.clone(), values).unwrap();
    let demonstration = Demonstration { name: "one".into(), trajectory, theta_m: Vec::new(), theta_f: Vec::new() };
    let dataset = Dataset {
        motion: columns,
        wrench: Vec::new(),
        parameter_source: cpdmp::demonstration::ParameterSource::Given,
        demonstrations: vec![demonstration],
    };
    let settings = LearningSettings { shaping: ShapingKind::Lwr, ..Default::default() };
    let skill = learn(&dataset, &settings, 0).unwrap().skill;
    let space = CouplingSpace::Joint { compliance_rad_per_nm: vec![0.05], saturation_rad: 0.5 };
    let coupling = CouplingSettings { space, ..coupled(CouplingMode::MinimiseForceError, ForceConvention::OnRobot) };
    let mut pushed = SkillExecution::new(&skill, &ExecutionSettings { coupling, ..Default::default() }).unwrap();
    let arm = |q: &[f64]| {
        let (a, b) = (q[0], q[0] + q[1]);
        let mut jacobian = Matrix6xX::zeros(2);
        jacobian[(0, 0)] = -0.5 * (a.sin() + b.sin());
        jacobian[(1, 0)] = 0.5 * (a.cos() + b.cos());
        (jacobian[(0, 1)], jacobian[(1, 1)]) = (-0.5 * b.sin(), 0.5 * b.cos());
        (jacobian[(5, 0)], jacobian[(5, 1)]) = (1.0, 1.0);
        jacobian
    };
    let wrench = [0.0, 4.0, 0.0, 0.0, 0.0, 0.0];
    let mut power = f64::NEG_INFINITY;
    for i in 0..200 {
        let jacobian = arm(pushed.state().position.as_slice());
        let input = StepInput { wrench: &wrench, jacobian: Some(&jacobian), ..StepInput::of(0.01) };
        pushed.check_input(&input).unwrap();
        let counted = allocation_counter::measure(|| _ = pushed.step(&input));
        assert_eq!(counted.count_total, 0, "step {i}");
        power = (jacobian.transpose() * Vector6::from(wrench)).dot(&pushed.state().deviation);
    }
    assert!(power > 0.0, "the joints go where the hand pushes the tip");
    assert!(pushed.state().deviation.norm() > 0.05);
    let wrong = Matrix6xX::zeros(7);
    let input = StepInput { wrench: &[0.0; 3], jacobian: Some(&wrong), ..StepInput::of(0.01) };
    let message = pushed.check_input(&input).unwrap_err().to_string();
    assert!(message.contains("6 x 7") && message.contains("6 x 2") && message.contains("3 values"), "{message}");
    assert!(pushed.step(&input).zeta.iter().all(|z| *z == 0.0), "what does not fit does not act");
}

/// Power does not depend on where it is written down: the adjoint is the transpose of that of twists.
#[test]
fn a_wrench_at_the_sensor_has_the_same_power_at_the_tool() {
    let mut random = stream(5, "adjoint", 0);
    for _ in 0..50 {
        let mut three = || Vector3::from_fn(|_, _| uniform(&mut random, -1.0, 1.0));
        let tool_from_sensor = Isometry3::new(three(), three());
        let (linear, angular, force, torque) = (three(), three(), three(), three());
        let wrench = Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z);
        let back = tool_from_sensor.rotation.inverse();
        let at_sensor = back * (linear + angular.cross(&tool_from_sensor.translation.vector));
        let power = at_sensor.dot(&force) + (back * angular).dot(&torque);
        let moved = wrench_at_tool(&tool_from_sensor, &wrench);
        assert!((moved.fixed_rows::<3>(0).dot(&linear) + moved.fixed_rows::<3>(3).dot(&angular) - power).abs() < 1e-13);
    }
}
