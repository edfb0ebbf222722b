//! Work on pieces in threads, its results in the order of the pieces.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::panic::resume_unwind;
use std::thread::{self, ScopedJoinHandle};

/// How many threads the machine has work for.
pub(crate) fn workers() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Hands what `work` makes of each piece to `take`, in the order of the pieces: the same for any number of `workers`. Pieces are read by
/// the caller's thread, one ahead; never are there more than one for each worker and that one.
///
/// # Errors
/// The first in the order of the pieces, of reading, working or taking.
pub(crate) fn in_order<P: Send, R: Send, E: Send>(
    workers: usize,
    pieces: impl Iterator<Item = Result<P, E>>,
    work: impl Fn(P) -> Result<R, E> + Sync,
    mut take: impl FnMut(R) -> Result<(), E>,
) -> Result<(), E> {
    let work = &work;
    thread::scope(|scope| {
        let mut running: VecDeque<ScopedJoinHandle<'_, Result<R, E>>> = VecDeque::new();
        let mut take_next = |running: &mut VecDeque<ScopedJoinHandle<'_, Result<R, E>>>| {
            let Some(next) = running.pop_front() else {
                return Ok(());
            };
            take(next.join().unwrap_or_else(|panic| resume_unwind(panic))?)
        };
        for piece in pieces {
            if running.len() >= workers.max(1) {
                take_next(&mut running)?;
            }
            // What could not be read has its turn, too.
            running.push_back(scope.spawn(move || work(piece?)));
        }
        while !running.is_empty() {
            take_next(&mut running)?;
        }
        Ok(())
    })
}

/// What `work` makes of each piece, in their order, on all cores.
pub(crate) fn each<P: Send, R: Send>(
    pieces: impl Iterator<Item = P>,
    work: impl Fn(P) -> R + Sync,
) -> Vec<R> {
    let mut found = Vec::new();
    let work = |piece| Ok::<R, Infallible>(work(piece));
    let Ok(()) = in_order(workers(), pieces.map(Ok), work, |one| {
        found.push(one);
        Ok(())
    });
    found
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    use super::*;

    /// Early pieces take longest.
    fn slow(piece: u64) -> u64 {
        thread::sleep(Duration::from_millis(20_u64.saturating_sub(2 * piece)));
        piece * piece
    }

    #[test]
    fn results_come_in_the_order_of_the_pieces() {
        let wanted: Vec<u64> = (0..12).map(|k| k * k).collect();
        for workers in [0, 1, 2, 5, 40] {
            let mut found = Vec::new();
            let square = |piece| Ok::<u64, u64>(slow(piece));
            let done = in_order(workers, (0..12).map(Ok), square, |square| {
                found.push(square);
                Ok(())
            });
            assert_eq!((done, &found), (Ok(()), &wanted), "{workers}");
        }
    }

    #[test]
    fn pieces_are_read_one_ahead_at_most() {
        for workers in [1, 3] {
            let (read, taken) = (AtomicUsize::new(0), AtomicUsize::new(0));
            let pieces = (0..20).inspect(|_| {
                let ahead = read.fetch_add(1, Ordering::SeqCst) - taken.load(Ordering::SeqCst);
                assert!(ahead <= workers, "{ahead} of {workers}");
            });
            let done = in_order(workers, pieces.map(Ok::<u64, u64>), Ok, |_| {
                taken.fetch_add(1, Ordering::SeqCst);
                Ok(())
            });
            assert_eq!((done, taken.into_inner()), (Ok(()), 20));
        }
    }

    #[test]
    fn the_first_error_is_that_of_the_first_piece() {
        for workers in [1, 2, 5] {
            // Piece 3 is slow to fail, piece 5 cannot be read.
            let pieces = (0..8).map(|k| if k == 5 { Err(50) } else { Ok(k) });
            let work = |k: u64| {
                slow(k);
                if k == 3 { Err(30) } else { Ok(k) }
            };
            let mut taken = Vec::new();
            let done = in_order(workers, pieces.clone(), work, |k| {
                taken.push(k);
                Ok(())
            });
            assert_eq!((done, taken), (Err(30), vec![0, 1, 2]), "{workers}");
            let done = in_order(workers, pieces, |k| Ok(slow(k)), |_| Ok(()));
            assert_eq!(done, Err(50));
        }
    }
}
