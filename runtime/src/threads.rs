//! Work that is shared among all cores, with the same results as on one.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A function of every item, on all cores, in the order of the items.
pub(crate) fn map<T: Sync, R: Send>(items: &[T], of: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let workers = workers.min(items.len());
    if workers < 2 {
        return items.iter().map(of).collect();
    }
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(number) else {
                return;
            };
            let result = of(item);
            done.lock()
                .expect("no panic while it is held")
                .push((number, result));
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(work);
        }
    });
    let mut done = done.into_inner().expect("no panic while it is held");
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
}
