//! Pieces of a reproduction that do not wait for each other, on all cores.

use std::sync::Mutex;
use std::thread;

use super::Error;

/// Results in the order of the jobs; the last ones are begun first.
///
/// # Errors
/// The first one of the jobs'.
pub fn in_threads<J: Sync, R: Send>(
    jobs: &[J],
    work: impl Fn(&J) -> Result<R, Error> + Sync,
) -> Result<Vec<R>, Error> {
    let left = Mutex::new((0..jobs.len()).collect::<Vec<usize>>());
    let next = || left.lock().ok()?.pop();
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let mut results: Vec<(usize, Result<R, Error>)> = thread::scope(|scope| {
        let worker = || {
            let mut own = Vec::new();
            while let Some(k) = next() {
                own.push((k, work(&jobs[k])));
            }
            own
        };
        let workers: Vec<_> = (0..threads.min(jobs.len()))
            .map(|_| scope.spawn(worker))
            .collect();
        let ended = workers.into_iter().map(thread::ScopedJoinHandle::join);
        ended
            .flat_map(|own| own.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    results.sort_by_key(|(k, _)| *k);
    results.into_iter().map(|(_, result)| result).collect()
}

/// Two results at once.
///
/// # Errors
/// That of the first, or that of the second.
pub fn both<A: Send, B: Send>(
    one: impl FnOnce() -> Result<A, Error> + Send,
    other: impl FnOnce() -> Result<B, Error>,
) -> Result<(A, B), Error> {
    thread::scope(|scope| {
        let one = scope.spawn(one);
        let other = other();
        let one = one.join();
        let one = one.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
        Ok((one, other?))
    })
}

#[cfg(test)]
mod tests {
    use super::{both, in_threads};

    #[test]
    fn results_and_the_first_error_are_in_the_order_of_the_jobs() {
        let jobs: Vec<u32> = (0..100).collect();
        let squares = in_threads(&jobs, |k| Ok(k * k)).expect("no job fails");
        assert!((0..100).map(|k| k * k).eq(squares));
        let failed = in_threads(&jobs, |k| match k {
            0..7 => Ok(*k),
            _ => Err(format!("job {k}").into()),
        });
        assert_eq!(failed.unwrap_err().to_string(), "job 7");
    }

    #[test]
    fn two_come_at_once_and_the_error_of_the_first_is_told() {
        assert_eq!(
            both(|| Ok(1), || Ok("two")).expect("none fails"),
            (1, "two")
        );
        let fails = |name: &'static str| move || Err::<u32, _>(name.into());
        let failed = both(fails("one"), fails("other"));
        assert_eq!(failed.unwrap_err().to_string(), "one");
    }
}
