//! Rays in all the forms that `kdray query` reads.

use npyz::{AutoSerialize, Order, Serialize, WriteOptions, WriterBuilder};

/// Rays of 6 or 8 numbers around the unit ball: most aim at it, some graze it, some miss.
pub(crate) fn rays(count: usize, columns: usize) -> Vec<Vec<f64>> {
    let mut state = 1_u64;
    let mut random = || {
        // Knuth's linear congruential generator (MMIX); the high bits are good.
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1_u64 << 24) as f64 * 2.0 - 1.0
    };
    let mut ray = |_| {
        let origin = [0; 3].map(|_| 2.0 * random());
        let target = [0; 3].map(|_| 1.2 * random());
        let direction = [0, 1, 2].map(|i| target[i] - origin[i]);
        let rest = [0.25 * random().abs(), 0.5 + random().abs()];
        let numbers = origin.into_iter().chain(direction).chain(rest);
        // Whole f32 numbers, so that the same rays can be written in both precisions.
        numbers.take(columns).map(|x| f64::from(x as f32)).collect()
    };
    (0..count).map(&mut ray).collect()
}

/// The rays as npy with numbers of type T.
pub(crate) fn npy<T: Serialize + AutoSerialize>(
    rays: &[Vec<f64>],
    order: Order,
    number: impl Fn(f64) -> T,
) -> Vec<u8> {
    let columns = rays[0].len();
    let mut bytes = Vec::new();
    let options = WriteOptions::new().default_dtype().order(order);
    let shape = [rays.len() as u64, columns as u64];
    let mut writer = options.shape(&shape).writer(&mut bytes).begin_nd().expect("a header");
    let rows = rays.len();
    let numbers = (0..rows * columns).map(|i| match order {
        Order::C => number(rays[i / columns][i % columns]),
        Order::Fortran => number(rays[i % rows][i / rows]),
    });
    writer.extend(numbers).expect("numbers");
    writer.finish().expect("an array");
    bytes
}

/// The rays as lines of numbers.
pub(crate) fn csv(rays: &[Vec<f64>]) -> String {
    let line = |ray: &Vec<f64>| ray.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    rays.iter().map(|ray| line(ray) + "\n").collect()
}

/// An npy file whose header and numbers need not fit.
pub(crate) fn raw_npy(descr: &str, shape: &str, numbers: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), numbers].concat()
}
