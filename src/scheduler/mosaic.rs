//! A grid of cells that is filled from coarse to fine, first where neighbours differ.

/// A grid of `columns` x `rows` cells. Cells on multiples of 2^level are computed first and stand for the block around
/// them until finer ones are known.
#[derive(Debug, Clone)]
pub struct Mosaic<T> {
    columns: usize,
    rows: usize,
    coarsest: usize,
    cells: Vec<Option<T>>,
    handed: Vec<bool>,
    known: usize,
}

/// A cell by column and row.
pub type Place = (usize, usize);

/// Fewest cells along the longer side of the first picture; less than twice as many.
const FIRST_PICTURE: usize = 16;

impl<T: PartialEq> Mosaic<T> {
    /// An empty grid.
    pub fn new(columns: usize, rows: usize) -> Self {
        let coarsest = 1 << (columns.max(rows) / FIRST_PICTURE).max(1).ilog2();
        let count = columns * rows;
        let cells = std::iter::repeat_with(|| None).take(count).collect();
        Self { columns, rows, coarsest, cells, handed: vec![false; count], known: 0 }
    }

    /// Columns and rows.
    pub fn size(&self) -> (usize, usize) {
        (self.columns, self.rows)
    }

    /// Known cells over all.
    pub fn progress(&self) -> f64 {
        self.known as f64 / self.cells.len().max(1) as f64
    }

    /// Whether cells of the first picture are still to be handed out.
    pub fn sketches(&self) -> bool {
        !self.level(self.coarsest, 1, |_| true).is_empty()
    }

    /// Whether the first picture is there.
    pub fn is_sketched(&self) -> bool {
        let rows = (0..self.rows).step_by(self.coarsest);
        let mut places = rows.flat_map(|j| (0..self.columns).step_by(self.coarsest).map(move |i| (i, j)));
        places.all(|place| self.get(place).is_some())
    }

    /// Sets a cell.
    pub fn put(&mut self, place: Place, value: T) {
        let index = self.index(place);
        self.known += usize::from(self.cells[index].is_none());
        self.handed[index] = true;
        self.cells[index] = Some(value);
    }

    /// The cell itself, when it is known.
    pub fn get(&self, place: Place) -> Option<&T> {
        self.cells.get(self.index(place)).and_then(Option::as_ref)
    }

    /// What is shown at a place: the cell, or the nearest coarser one that stands for it.
    pub fn shown(&self, (i, j): Place) -> Option<&T> {
        let mut stride = 1;
        while stride <= self.coarsest {
            let nearest = |k: usize, count: usize| {
                let place = (k + stride / 2) / stride * stride;
                if place < count { place } else { (count - 1) / stride * stride }
            };
            if let Some(cell) = self.get((nearest(i, self.columns), nearest(j, self.rows))) {
                return Some(cell);
            }
            stride *= 2;
        }
        None
    }

    /// Up to `most` cells to compute next, marked as handed out: those of the coarsest level, then those between
    /// neighbours that `differ`, from coarse to fine, then the rest from coarse to fine.
    pub fn hand_out(&mut self, most: usize, differ: impl Fn(&T, &T) -> bool) -> Vec<Place> {
        let mut places = self.level(self.coarsest, most, |_| true);
        let mut stride = self.coarsest / 2;
        while stride >= 1 && places.len() < most {
            let room = most - places.len();
            places.extend(self.level(stride, room, |place| self.between(place, stride, &differ)));
            stride /= 2;
        }
        let mut stride = self.coarsest / 2;
        while stride >= 1 && places.is_empty() {
            places = self.level(stride, most, |_| true);
            stride /= 2;
        }
        for place in &places {
            let index = self.index(*place);
            self.handed[index] = true;
        }
        places
    }

    /// Cells on multiples of `stride` that nobody has yet and that are `wanted`.
    fn level(&self, stride: usize, most: usize, wanted: impl Fn(Place) -> bool) -> Vec<Place> {
        // Column by column: what changes along a column may be cheaper to change.
        let columns = (0..self.columns).step_by(stride);
        let places = columns.flat_map(|i| (0..self.rows).step_by(stride).map(move |j| (i, j)));
        places.filter(|place| !self.handed[self.index(*place)] && wanted(*place)).take(most).collect()
    }

    /// Whether the known cells of the next coarser level around a place differ.
    fn between(&self, (i, j): Place, stride: usize, differ: &impl Fn(&T, &T) -> bool) -> bool {
        let wide = 2 * stride;
        let (left, low) = (i / wide * wide, j / wide * wide);
        let corners = [(left, low), (left + wide, low), (left, low + wide), (left + wide, low + wide)];
        let inside = corners.into_iter().filter(|(i, j)| *i < self.columns && *j < self.rows);
        let mut known = inside.filter_map(|place| self.get(place));
        let Some(first) = known.next() else { return false };
        known.any(|other| differ(first, other))
    }

    fn index(&self, (i, j): Place) -> usize {
        j * self.columns + i
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fills a grid with a disc, three cells at a time, and returns the order.
    fn fill(mosaic: &mut Mosaic<bool>) -> Vec<Place> {
        let mut order = Vec::new();
        loop {
            let places = mosaic.hand_out(3, |a, b| a != b);
            if places.is_empty() {
                return order;
            }
            for (i, j) in places {
                mosaic.put((i, j), inside((i, j)));
                order.push((i, j));
            }
        }
    }

    fn inside((i, j): Place) -> bool {
        (i as f64 - 20.0).hypot(j as f64 - 15.0) < 9.0
    }

    #[test]
    fn every_cell_is_handed_out_once_and_the_picture_ends_exact() {
        for (columns, rows) in [(48, 33), (1, 1), (5, 200), (64, 64)] {
            let mut mosaic = Mosaic::new(columns, rows);
            let mut order = fill(&mut mosaic);
            assert_eq!(order.len(), columns * rows);
            order.sort_unstable();
            order.dedup();
            assert_eq!(order.len(), columns * rows);
            assert_eq!(mosaic.progress(), 1.0);
            for place in order {
                assert_eq!(mosaic.shown(place), Some(&inside(place)));
            }
        }
    }

    #[test]
    fn the_border_is_fine_long_before_the_rest() {
        let mut mosaic = Mosaic::new(48, 48);
        let order = fill(&mut mosaic);
        let on_border = |(i, j): &Place| inside((*i, *j)) != inside((i + 1, *j));
        let last_border = order.iter().rposition(on_border).expect("a border");
        assert!(last_border < order.len() / 2, "{last_border} of {}", order.len());
    }

    #[test]
    fn a_coarse_picture_covers_everything() {
        let mut mosaic = Mosaic::new(50, 37);
        let places = mosaic.hand_out(usize::MAX, |a: &usize, b| a != b);
        assert_eq!(places.len(), 25 * 19);
        for (k, place) in places.into_iter().enumerate() {
            mosaic.put(place, k);
        }
        assert!((0..50).all(|i| (0..37).all(|j| mosaic.shown((i, j)).is_some())));
    }
}
