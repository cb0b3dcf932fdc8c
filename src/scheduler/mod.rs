//! Who computes what, where, and for how long: studies hand out pieces of work, lanes keep the newest question of each
//! topic, a foreman keeps the book of the workers. It knows pieces and tickets, and nothing of what they are about.

pub mod budget;
pub mod foreman;
pub mod lane;
pub mod mosaic;
pub mod parallel;
pub mod piece;
pub mod single;
pub mod study;
pub mod table;

pub use budget::Budget;
pub use lane::{Lane, Lanes};
pub use piece::{Failure, Finding, Piece, Work};
pub use single::Single;
pub use study::{Order, Study, complete, complete_within};
pub use table::Table;
