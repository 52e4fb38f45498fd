//! Who moves, what it is told, and on which side it passes.

use crate::palette::{BLACK, BLUE, GREEN, ORANGE, PINK, Rgb, SKY_BLUE, VERMILION};

/// Colours of chains, in order; with more chains they come again.
const CHAIN_COLORS: [Rgb; 6] = [ORANGE, SKY_BLUE, GREEN, PINK, VERMILION, BLUE];

/// The colour of a chain, wherever it is drawn.
#[must_use]
pub fn chain_color(chain: usize) -> Rgb {
    CHAIN_COLORS[chain % CHAIN_COLORS.len()]
}

/// What made a movement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// The parametric model of the paper, read by regression over all its states.
    Cpdmp,
    /// The same, told `side x half width` as a third parameter: means that are linear in `theta` cannot form a product.
    CpdmpProduct,
    /// The same model as [`Self::Cpdmp`] taken apart: regression over the states of one chain.
    CpdmpChain,
    /// A primitive whose forcing term is locally weighted regression, blind to parameters; it is told the new goal.
    LwrDmp,
    /// Task-parameterised Gaussian mixture: the paper's rival.
    TpGmm,
}

impl Method {
    /// Its name in keys and columns.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Cpdmp => "cpdmp",
            Self::CpdmpProduct => "cpdmp_product",
            Self::CpdmpChain => "cpdmp_chain",
            Self::LwrDmp => "lwr_dmp",
            Self::TpGmm => "tp_gmm",
        }
    }

    /// Its name in tables and figures.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Cpdmp => "CPDMP",
            Self::CpdmpProduct => "CPDMP, side x width",
            Self::CpdmpChain => "CPDMP by chain",
            Self::LwrDmp => "LWR-DMP",
            Self::TpGmm => "TP-GMM",
        }
    }

    /// Its colour, wherever it is drawn and nothing else has one, with the colour's name.
    #[must_use]
    pub fn look(self) -> (Rgb, &'static str) {
        match self {
            Self::Cpdmp => (BLUE, "blue"),
            Self::CpdmpProduct => (PINK, "pink"),
            Self::CpdmpChain => (GREEN, "green"),
            Self::LwrDmp => (ORANGE, "orange"),
            Self::TpGmm => (BLACK, "black"),
        }
    }

    /// Its colour alone.
    #[must_use]
    pub fn color(self) -> Rgb {
        self.look().0
    }

    /// Whether it is one of the paper's, not a rival.
    #[must_use]
    pub fn is_cpdmp(self) -> bool {
        matches!(self, Self::Cpdmp | Self::CpdmpProduct | Self::CpdmpChain)
    }
}

/// On which side of the obstacle a movement passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Side {
    /// Negative x.
    Left,
    /// Positive x.
    Right,
}

impl Side {
    /// -1 or +1, as in `theta`.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }

    /// Its name in keys, tables and figures.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// What a model is told beside the shape of the task.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Guidance {
    /// The task leaves no choice of the side (section 4.1).
    OneSide,
    /// The side is a parameter (section 4.2, first part).
    WithSide,
    /// The side is not told (section 4.2, second part).
    WithoutSide,
}

impl Guidance {
    /// Its name in keys, columns and entities.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::OneSide => "one_side",
            Self::WithSide => "with_side",
            Self::WithoutSide => "without_side",
        }
    }

    /// What the models are told of the side, in words; none where the task leaves no choice of it.
    #[must_use]
    pub fn told(self) -> Option<&'static str> {
        match self {
            Self::OneSide => None,
            Self::WithSide => Some("side told"),
            Self::WithoutSide => Some("side not told"),
        }
    }
}
