//! The wheel over plots: it scrolls the page and nothing else.

use std::collections::BTreeMap;

use crate::page::{Page, Theme, dist};

/// Pixels of a turn, and most turns from the top of a tab to its end.
const TURN: i64 = 200;
const MOST: usize = 12;

/// Where the cards in sight are.
fn tops(page: &Page) -> BTreeMap<String, f64> {
    let cards = page.controls().into_iter().filter(|control| control.label.starts_with("Enlarge: "));
    cards.map(|control| (control.label, control.bounds[1])).collect()
}

fn scroll_over_every_plot(page: &mut Page) {
    page.wait_until("the first run", |state| state["status"] == "done");
    for key in ['1', '3'] {
        page.keys(&[], key);
        page.wait("the plots of the tab", |page| (!tops(page).is_empty()).then_some(()));
        let mut passed: BTreeMap<String, usize> = BTreeMap::new();
        for (x, by) in [(520.0, TURN), (820.0, -TURN)] {
            page.hover((x, 420.0));
            for turn in 0..MOST {
                let before = tops(page);
                page.wheel((x, 420.0), by);
                let moved = |page: &Page| {
                    let now = tops(page);
                    let way = |(label, top): (&String, &f64)| Some(now.get(label)? - top);
                    before.iter().filter_map(way).next().is_none_or(|way| way.abs() > 1.0).then_some(())
                };
                // The end of the page is where a turn moves nothing for a while.
                let went = (0..50).any(|_| {
                    std::thread::sleep(std::time::Duration::from_millis(20));
                    moved(page).is_some()
                });
                let fits =
                    page.controls().into_iter().any(|control| control.label.starts_with("Fit the view"));
                assert!(!fits, "tab {key}: the wheel changed a plot");
                tops(page).into_keys().for_each(|label| *passed.entry(label).or_default() += 1);
                if !went {
                    assert!(turn > 0, "tab {key}: the page did not move");
                    break;
                }
            }
        }
        assert!(!passed.is_empty(), "tab {key}");
    }
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_wheel_over_every_plot_moves_the_page_and_no_axis() {
    let mut page = Page::open(1100, 620, Theme::Dark);
    scroll_over_every_plot(&mut page);
    page.close();
}

#[test]
#[ignore = "needs the built page and Firefox: make test"]
fn the_wheel_over_every_plot_moves_the_page_in_firefox_too() {
    let mut page = Page::open_in_firefox(&dist(), 1100, 620, Theme::Light);
    scroll_over_every_plot(&mut page);
    page.close();
}
