//! The one list of what the recording of a planar experiment holds: its timeline and its entities, by name and meaning.

use super::entity_path::{Entity, Timeline, entities};

/// What the models see of the phase.
pub const PHASE_INPUT: Timeline = Timeline {
    name: "phase_input",
    meaning: "what the models see of the phase, 1 s being 1: the elapsed fraction u of the movement, or s where settings say so",
};

// What is drawn later, in the order of the paths, covers what was drawn before.
entities! {
    MAP "map" "turns the plane up: y points up in the view, as in the data, and not down, as in pictures"
    GRID "map/grid" "lines at whole metres"
    GRID_NUMBERS "map/grid/numbers" "coordinates of some of them (m)"
    OBSTACLES "map/obstacles" "every obstacle that is passed, of several each in a colour of its own"
    DEMONSTRATIONS "map/demonstrations" "paths of the demonstrations"
    GOALS "map/goals" "where movements should end: dark where that was taught, yellow where, if anywhere, it was not"
    TAUGHT "map/movements/{told}/{method}/taught" "paths of a method for situations that were demonstrated, in its colour, or in that of the obstacle where there are several"
    UNSEEN "map/movements/{told}/{method}/unseen" "its paths for situations that were not"
    COLLISIONS "map/movements/{told}/{method}/collisions" "where a path that touches the obstacle is deepest inside"
    PLACES "map/movements/{told}/{method}/places" "where its movements are at this phase"
    DEMONSTRATED "forcing/demonstrated/{axis}/{demonstration}" "what the forcing term of a demonstration must have been, eq. 4 of the paper (m)"
    GAUSSIANS "forcing/{told}/{method}/{axis}/gaussians/{situation}"
        "states of the model in a situation as thin ellipses at two standard deviations, upper and lower halves (m)"
    CURVE "forcing/{told}/{method}/{axis}/curves/{situation}" "forcing term of the model in a situation, a thick line (m)"
    GRAPH "transitions" "which state of the model that is not told the side follows which, each chain in a colour"
    RESULT "result" "how the experiment ended: its criteria, and which movements collide"
    CLEARANCES "clearances" "how near every movement comes to the obstacle"
    GUIDE "guide" "how to read this recording"
    CONTENTS "contents" "its timeline and its entities"
}
