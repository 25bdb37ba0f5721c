//! One file for each bug that was fixed, named for what it was.

mod order_of_waiting_nodes;
mod overflow_in_the_filter;
mod underflow_of_den;
mod underflow_of_t;
