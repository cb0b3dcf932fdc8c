//! Who computes what, where, and for how long: studies hand out pieces of work, lanes keep the newest question of each
//! topic, a foreman keeps the book of the workers. It knows pieces and tickets, and nothing of what they are about.
//!
//! Whatever takes longer than a frame is a `scheduler::Study`: it hands out pieces of work, each a fraction of a
//! second, and puts the findings together, coarse before fine. A `Piece` names the type of what it finds, and an
//! `Order` holds the piece with what its study does when it comes back, so that a finding of another kind cannot be
//! written down. Only in the book of `scheduler::foreman` and on the way to a worker are both without their types: as
//! a name and bytes, which the `HANDS` of `questions::list` read (a test sends one piece of each kind). The foreman
//! keeps the book: which worker does which piece for which question. An answer to an old question is dropped; a piece
//! whose worker died is done again by another, and given up when it has killed two. Natively `scheduler::complete`
//! gives the pieces to rayon, takes findings in the order of the pieces, so that an answer does not depend on the
//! cores, and begins none when the `Budget` of a request is spent; in the page `app::crew` gives them to web workers
//! and takes findings in inside the message handler, so that work goes on in a background tab.
//!
//! A piece that may take long tells how far it is: its worker sends that while it computes (in the page; natively progress
//! goes by whole pieces), its lane counts it, and a worker that is heard of is not taken for one that hangs. To stop a study,
//! or to go on with it, its lane is `redirect`ed: what is under way is obsolete then, as after another question, so that a
//! worker that does not come to an end is replaced. What was stopped stays asked, and so is not begun again by itself.
//!
//! A lane is found by the type of its study; `questions::list::lanes` says which there are, and which are urgent. It
//! asks anew when what is [`Asked`] differs from the last. What plays no role in an answer is taken out by
//! `Scenario::forgetting` before that, so that moving it asks nothing new.
//!
//! The workers run the page's own module: the page hands its compiled `WebAssembly.Module` over, and the entry point
//! does nothing where there is no window. So there is no second download, no second compilation, and page and workers
//! cannot be of different versions. Messages are bytes (`nanoserde`): no shared memory, so no special headers are
//! needed.
//!
//! While a pointer is down, all but one worker leave background studies alone, and the frame keeps its core; first, coarse
//! pictures are drawn all the same. Questions that change as fast as a slider moves are `offer`ed rather than asked: the
//! present one is finished first, or has its first picture, then the newest is taken up.

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
pub use piece::{Failure, Finding, Piece, Tell, Work};
pub use single::Single;
pub use study::{Asked, Order, Study, complete, complete_within};
pub use table::Table;
