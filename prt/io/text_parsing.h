#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace prt {

/// The lines of a text, whatever they end with: \n, \r\n or \r. The last one need not end.
class LineReader {
  public:
    explicit LineReader(std::string_view text) : rest_(text) {}

    /// The next line without its end, or nothing after the last.
    std::optional<std::string_view> next();

    /// Of the line that next() returned, from 1.
    std::size_t lineNumber() const { return lineNumber_; }
    /// What follows that line.
    std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_;
    std::size_t lineNumber_ = 0;
};

/// Takes the next word off the front of a text; empty when there is none. Words are parted by
/// blanks, tabs and line ends.
std::string_view takeWord(std::string_view& text);

/// The text without blanks and tabs at its ends.
std::string_view trim(std::string_view text);

/// The whole word as a number in the "C" locale, correctly rounded;
/// "nan" and "inf" are numbers too.
template <class Number>
std::optional<Number> parseNumber(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    Number number{};
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (failure != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return number;
}

/// The whole word as a finite number that a float can hold.
std::optional<float> parseFiniteFloat(std::string_view word);

}  // namespace prt
