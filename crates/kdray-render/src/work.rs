//! The state of a render while it is under way, shared by all threads.

use crate::film::{Film, PixelValues};
use crate::picture::Picture;
use crate::tiles::Tiles;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// How far a render is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RenderProgress {
    /// The part that is done, from 0 to 1, never falling.
    pub fraction: f64,
    /// Tiles that are done.
    pub tiles_done: usize,
    /// All tiles.
    pub tiles: usize,
    /// Rays of all kinds shot so far.
    pub rays: u64,
}

/// What threads share.
pub(crate) struct Work<'a> {
    tiles: Tiles,
    state: Mutex<State>,
    /// Whoever calls back holds this: how many tiles were done at the last call.
    told: Mutex<usize>,
    callback: &'a (dyn Fn(RenderProgress) -> ControlFlow<()> + Sync),
    stopped: AtomicBool,
}

struct State {
    film: Film,
    progress: RenderProgress,
}

impl<'a> Work<'a> {
    pub(crate) fn new(
        film: Film,
        tiles: Tiles,
        callback: &'a (dyn Fn(RenderProgress) -> ControlFlow<()> + Sync),
    ) -> Self {
        let state = Mutex::new(State { film, progress: RenderProgress::default() });
        Self { tiles, state, told: Mutex::new(0), callback, stopped: AtomicBool::new(false) }
    }

    pub(crate) fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// A panic while the lock is held would be passed on by rayon; the data stays usable.
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps the pixels of a tile.
    pub(crate) fn keep(&self, pixels: impl Iterator<Item = ([usize; 2], PixelValues)>, rays: u64) {
        let mut state = self.state();
        for (pixel, values) in pixels {
            state.film.set(self.tiles.window.index(pixel), &values);
        }
        state.progress.advance(self.tiles.count(), rays);
    }

    /// Tells how far the work is, unless the answer was to stop, or a call is under way. Nobody may
    /// wait for that one: if it uses rayon, its own thread may turn to another tile meanwhile, and
    /// end up here.
    pub(crate) fn tell(&self) {
        let Ok(mut told) = self.told.try_lock() else { return };
        if self.is_stopped() {
            return;
        }
        let progress = self.state().progress;
        if progress.tiles_done > *told {
            *told = progress.tiles_done;
            if (self.callback)(progress).is_break() {
                self.stopped.store(true, Ordering::Relaxed);
            }
        }
    }

    /// Tells of what is not told yet, and gives the picture.
    pub(crate) fn finish(self) -> Picture {
        self.tell();
        let State { film, progress } =
            self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        film.develop(progress.tiles_done == self.tiles.count())
    }
}

impl RenderProgress {
    fn advance(&mut self, tiles: usize, rays: u64) {
        self.tiles_done += 1;
        self.tiles = tiles;
        self.fraction = self.tiles_done as f64 / tiles as f64;
        self.rays += rays;
    }
}
