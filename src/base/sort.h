// Heap sort: in place, without recursion, n log n in the worst case. Not stable, so callers' orders are total.
#pragma once

#include <cstddef>
#include <span>

namespace shodo {

/// Moves the element at `root` down until no child is larger; the heap has `count` elements.
template <class T, class Less>
void sift_down(std::span<T> items, std::size_t root, std::size_t count, Less less) {
  const T item = items[root];
  for (std::size_t child = 2 * root + 1; child < count; child = 2 * root + 1) {
    if (child + 1 < count && less(items[child], items[child + 1])) ++child;
    if (!less(item, items[child])) break;
    items[root] = items[child];
    root = child;
  }
  items[root] = item;
}

/// Ascending by `less`.
template <class T, class Less>
void heap_sort(std::span<T> items, Less less) {
  for (std::size_t k = items.size() / 2; k-- > 0;) sift_down(items, k, items.size(), less);
  for (std::size_t last = items.size(); last-- > 1;) {
    const T largest = items[0];
    items[0] = items[last];
    items[last] = largest;
    sift_down(items, 0, last, less);
  }
}

}  // namespace shodo
