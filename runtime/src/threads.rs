//! Work that is shared among all cores, with the same results as on one.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// A function of every item, on all cores, in the order of the items.
pub(crate) fn map<T: Sync, R: Send>(items: &[T], of: impl Fn(&T) -> R + Sync) -> Vec<R> {
    map_told(items, of, &mut |_| ())
}

/// The same, which tells how many items are done whenever one is.
pub(crate) fn map_told<T: Sync, R: Send>(
    items: &[T],
    of: impl Fn(&T) -> R + Sync,
    told: &mut dyn FnMut(usize),
) -> Vec<R> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let workers = workers.min(items.len());
    if workers < 2 {
        let each = items.iter().enumerate().map(|(number, item)| {
            let result = of(item);
            told(number + 1);
            result
        });
        return each.collect();
    }
    let next = AtomicUsize::new(0);
    let (next, of) = (&next, &of);
    let (sender, receiver) = mpsc::channel();
    let work = |sender: mpsc::Sender<(usize, R)>| {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(number) else {
                return;
            };
            // Nobody listens any more where `told` has panicked.
            if sender.send((number, of(item))).is_err() {
                return;
            }
        }
    };
    let mut done = std::thread::scope(|scope| {
        for _ in 0..workers {
            let sender = sender.clone();
            scope.spawn(move || work(sender));
        }
        drop(sender);
        let mut done = Vec::with_capacity(items.len());
        for result in receiver {
            done.push(result);
            told(done.len());
        }
        done
    });
    // The same results, whatever thread came to an item first.
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn results_are_in_the_order_of_their_items() {
        let items: Vec<u64> = (0..1000).collect();
        let found = super::map(&items, |item| {
            // Later items are done sooner.
            (0..1000 - item).fold(*item, |sum, k| sum ^ std::hint::black_box(k ^ k))
        });
        assert_eq!(found, items);
        assert_eq!(super::map(&[7], |x| x + 1), [8]);
        assert!(super::map(&[], |x: &u64| *x).is_empty());
    }

    #[test]
    fn every_item_is_told_as_it_is_done() {
        for count in [0, 1, 7] {
            let items: Vec<usize> = (0..count).collect();
            let mut told = Vec::new();
            super::map_told(&items, |item| *item, &mut |done| told.push(done));
            assert_eq!(told, (1..=count).collect::<Vec<_>>());
        }
    }
}
