//! Results as tables: named columns, and cells that hold a value or say why there is none.

use std::borrow::Cow;

use super::tails::Probability;

/// How an estimate stands. Whatever is not [`Ok`](Status::Ok) has no number, and says why.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// It is there, and finite.
    Ok,
    /// The data do not say what it needs to know (counts have no positions).
    NotAvailable,
    /// The data leave nothing to estimate from: no votes, no variance, nobody who differs.
    Degenerate,
    /// The likelihood has no maximum at a finite value.
    NoFiniteEstimate,
    /// The techniques fall into parts that were never compared with each other.
    Disconnected,
}

impl Status {
    /// In words, as it stands in tables and files.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::NotAvailable => "not available",
            Self::Degenerate => "degenerate",
            Self::NoFiniteEstimate => "no finite estimate",
            Self::Disconnected => "disconnected",
        }
    }
}

/// Why there is no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Undefined {
    /// How it stands; never [`Status::Ok`].
    pub status: Status,
    /// The reason in words.
    pub reason: &'static str,
}

impl Undefined {
    /// The condition has no votes.
    pub const NO_VOTES: Self = Self::degenerate("no votes");
    /// Needs single answers, the input has only counts.
    pub const COUNTS_ONLY: Self =
        Self::not_available("needs single answers, the input has only counts");
    /// No participant answered both ways.
    pub const NOTHING_TO_COMPARE: Self =
        Self::degenerate("no participant chose differently in the two conditions");

    /// The data leave nothing to estimate from.
    #[must_use]
    pub const fn degenerate(reason: &'static str) -> Self {
        Self {
            status: Status::Degenerate,
            reason,
        }
    }

    /// The data do not say what it needs to know.
    #[must_use]
    pub const fn not_available(reason: &'static str) -> Self {
        Self {
            status: Status::NotAvailable,
            reason,
        }
    }

    /// The likelihood has no maximum at a finite value.
    #[must_use]
    pub const fn no_finite_estimate(reason: &'static str) -> Self {
        Self {
            status: Status::NoFiniteEstimate,
            reason,
        }
    }

    /// Parts were never compared with each other.
    #[must_use]
    pub const fn disconnected(reason: &'static str) -> Self {
        Self {
            status: Status::Disconnected,
            reason,
        }
    }
}

/// A closed interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// One value of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A name or a verdict.
    Text(String),
    /// How many.
    Count(u32),
    /// A finite number.
    Number(f64),
    /// A p-value.
    Probability(Probability),
    /// Two finite ends.
    Interval(Interval),
    /// No value, and why.
    Undefined(Undefined),
}

impl Cell {
    /// The value, or the reason why there is none.
    pub fn or_undefined<T>(value: Result<T, Undefined>, cell: impl FnOnce(T) -> Self) -> Self {
        value.map_or_else(Self::Undefined, cell)
    }
}

/// How a column's numbers are best shown to a person. Files always hold every digit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Left-aligned words.
    Text,
    /// Left-aligned signs that are no words: a hash.
    Code,
    /// Whole numbers.
    Count,
    /// A number with this many decimals.
    Decimals(usize),
    /// An interval, both ends with this many decimals.
    Interval(usize),
    /// A number with this many decimals, a whole one without any.
    UpTo(usize),
    /// A p-value.
    P,
}

/// Which of the report's tables a column of the wide table of conditions belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Names the row; stands in every table.
    Key,
    /// Votes, shares and their intervals.
    Choices,
    /// Tests against an even split, and their corrections.
    Tests,
    /// How large the preference is.
    Effects,
    /// Evidence for or against an even split that is no p-value.
    Evidence,
    /// Position chosen and order shown.
    Position,
}

/// One column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name in CSV and JSON. An interval gives two: `key_low` and `key_high`.
    pub key: Cow<'static, str>,
    /// Heading for a person.
    pub title: Cow<'static, str>,
    /// How to show it.
    pub style: Style,
    /// Where to show it.
    pub group: Group,
}

impl Column {
    /// A column with fixed names.
    #[must_use]
    pub const fn new(key: &'static str, title: &'static str, style: Style, group: Group) -> Self {
        Self {
            key: Cow::Borrowed(key),
            title: Cow::Borrowed(title),
            style,
            group,
        }
    }

    /// Whether it holds intervals, which are two columns in files.
    #[must_use]
    pub fn is_interval(&self) -> bool {
        matches!(self.style, Style::Interval(_))
    }
}

/// Columns and rows; every row has one cell a column.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// The columns of some groups, in the order of the groups named.
    #[must_use]
    pub fn only(&self, groups: &[Group]) -> Self {
        let kept: Vec<usize> = groups
            .iter()
            .flat_map(|group| (0..self.columns.len()).filter(|&i| self.columns[i].group == *group))
            .collect();
        Self {
            columns: kept.iter().map(|&i| self.columns[i].clone()).collect(),
            rows: self
                .rows
                .iter()
                .map(|row| kept.iter().map(|&i| row[i].clone()).collect())
                .collect(),
        }
    }

    /// Cells of one column, by its key.
    pub fn column(&self, key: &str) -> impl Iterator<Item = &Cell> {
        let at = self.columns.iter().position(|column| column.key == key);
        self.rows
            .iter()
            .filter_map(move |row| at.map(|at| &row[at]))
    }
}
