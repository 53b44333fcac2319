//! What the page in a browser calls: a question as JSON, an answer as JSON. All physics and all words are the library's.
//!
//! The page writes a question of `n` bytes to [`room`]`(n)`, calls [`ask`], and reads as many bytes at [`answer`]. [`question`]
//! lists the questions.
#![allow(unsafe_code, reason = "names that the page can call")]

pub mod data_of;
pub mod held;
pub mod question;
pub mod robot;
pub mod seen;

use std::cell::RefCell;

thread_local! {
    static QUESTION: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Room for a question of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    QUESTION.with_borrow_mut(|question| {
        question.clear();
        question.resize(bytes, 0);
        question.as_mut_ptr()
    })
}

/// Answers the question in the room, and returns the number of bytes of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> usize {
    let told = QUESTION.with_borrow(|question| question::answer(&String::from_utf8_lossy(question)));
    ANSWER.with_borrow_mut(|answer| {
        *answer = told.into_bytes();
        answer.len()
    })
}

/// Address of the last answer, valid until the next question.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}
