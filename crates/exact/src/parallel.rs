//! One way to spread independent work over threads, which is the plain loop without the feature `parallel`.

/// `f` of all items, in their order; in rayon's pool if `worth` it and the feature `parallel` is on.
///
/// ```
/// assert_eq!(secant_exact::parallel::map(&[1, 2, 3], true, |n| n * n), [1, 4, 9]);
/// ```
pub fn map<T: Sync, R: Send>(items: &[T], worth: bool, f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    #[cfg(feature = "parallel")]
    if worth {
        use rayon::prelude::*;
        let flag = crate::stop::flag();
        return items.par_iter().map(|item| crate::stop::stoppable(flag.clone(), || f(item))).collect();
    }
    let _ = worth;
    items.iter().map(f).collect()
}
