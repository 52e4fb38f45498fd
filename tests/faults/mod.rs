//! Everything that can be wrong with what the program is given. One test per fault, on the real binary.
//!
//! The fault table and where each of its rows is held (`cli::` and `physics::` lie beside this folder); `map` keeps it true:
//!
//! | row | fault | exit | tests |
//! |---|---|---|---|
//! | 1 | malformed TOML | 3 | `scenario::text_that_is_not_toml_…` |
//! | 2 | unknown key; with `--lenient` a warning | 3, 0 | `scenario::an_unknown_key_…`, `…a_key_of_another_kind_…`, `…lenient_only_warns_…` |
//! | 3 | wrong type, out of range, all at once | 3 | `scenario::numbers_are_finite_…`, `scenario::values_have_types_…`, `scenario::all_faults_…` |
//! | 4 | another unit | 3 | `scenario::a_number_in_another_unit_…` |
//! | 5 | newer or older version | 3, 0 | `scenario::a_newer_language_…`, `cli::migrate` |
//! | 6 | `extends` in a circle, missing, too deep | 3 | `extends::a_circle_…`, `extends::a_chain_…`, `extends::a_missing_base_…` |
//! | 7 | files outside the roots | 3 | `extends::files_outside_…`, `extends::a_link_…`, `runs::row_7_…` |
//! | 8 | no text, too large, too deep | 3 | `hostile_files`, `robot_files::row_8_…`, `fuzz` |
//! | 9 – 12 | malformed robots | 3, 0 | `robot_files` |
//! | 13 | penetration at the start | 3 | `runs::row_13_…` |
//! | 14 – 23 | datasets, learning, skills | 3, 4, 10, 0 | `learning_files`; row 21: `coupling` |
//! | 24 | out of reach | 3 | `runs::row_24_…`, `cli::real_run::a_way_that_the_arm_cannot_go_…` |
//! | 25 | the simulation diverges | 11 | `runs::row_25_…`, `runs::rows_25_and_29_…` |
//! | 26 | a thin part is crossed between two steps | 10 | `cli::check_motion::a_sheet_…`, `physics::collisions_in_engine`, `physics::collisions` |
//! | 27 | the person's force | 0, 10 | `runs::row_27_…` |
//! | 28 | wrong forces | 0 | `runs::row_28_…` |
//! | 29 | time limit | 12 | `runs::row_29_…`, `runs::rows_25_and_29_…` |
//! | 33 | two runs for one folder, a lock that stayed, another sweep | 21, 20, 2, 3 | `cli::run_folder`, `cli::sweep::a_folder_goes_on_…` |
//! | 34 | no display, no viewer or a broken one | 0 | `runs::rows_34_and_38_…`, `cli::view::a_run_does_not_depend_…` |
//! | 35 | stdout closed or full, no terminal, locale | 0, 20 | `cli::commands::a_reader_who_leaves_…`, `…results_that_cannot_…`, `…colour_and_characters_…` |
//! | 36 | nothing selected, one of several invalid | 5, 3 | `cli::commands::nothing_selected_…`, `…every_scenario_is_checked_…`, `cli::sweep::a_sweep_of_nothing_…`, `…a_faulty_member_…` |
//! | 37 | replay differs, on another version or machine | 13 | `cli::replay::a_run_is_repeated_…`, `…another_version_…`, `…what_differs_…` |
//! | 38 | the machine's clock | 0 | `runs::rows_34_and_38_…` |

mod beside;
mod coupling;
mod extends;
mod fuzz;
mod hostile_files;
mod learning_files;
mod map;
mod robot_files;
mod runs;
mod scenario;
