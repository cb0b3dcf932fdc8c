//! The Lessons tab, and the guide that goes along with a running lesson on every tab.

mod guide;
mod list;
#[cfg(test)]
mod tests;
mod text;

pub(in crate::app) use guide::guide;
pub(in crate::app) use list::show;
