//! One file for each bug that was fixed, named for what it was.

mod angles_beside_corners;
mod areas_that_vanish;
mod crossings_where_rays_begin;
mod determinants_out_of_range;
mod far_planes;
mod hits_of_dead_rays;
mod lanes_behind_the_last_ray;
mod needles_in_tree_files;
mod order_of_waiting_nodes;
mod overflow_in_the_filter;
mod overflow_of_t;
mod rounded_way_to_a_target;
mod shares_beside_edges;
mod sign_of_zero;
mod slivers_beside_points;
mod slivers_under_points;
mod target_from_the_wrong_end;
mod targets_of_rays_from_afar;
mod ties_where_rays_begin;
mod triangles_left_out_of_sums;
mod underflow_in_a_long_triangle;
mod underflow_of_den;
mod underflow_of_t;
