#pragma once

#include <cstddef>
#include <span>

namespace prt {

/// Calls work(first, count) for each part of a list where a number is one more than the one before.
template <class Number, class Work>
void forRuns(std::span<const Number> numbers, Work work) {
    for (std::size_t first = 0; first < numbers.size();) {
        std::size_t end = first + 1;
        while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1)
            ++end;
        work(first, end - first);
        first = end;
    }
}

}  // namespace prt
