// The parts of a mutated copy of the engine. Every compiler call of its build includes this file first. All mutants are
// compiled into one program; the environment variable ETUDE_MUTANT chooses one by number, 0 = none.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <type_traits>

namespace etude_mutation {

constexpr int kMost = 1 << 18;
inline unsigned char reached[kMost];

inline void WriteReached() {
  // Each loaded module has its own list, so append.
  std::FILE* file = std::fopen(std::getenv("ETUDE_MUTANTS_REACHED"), "a");
  if (file == nullptr) std::abort();
  for (int number = 0; number < kMost; ++number) {
    if (reached[number] != 0) std::fprintf(file, "%d\n", number);
  }
  std::fclose(file);
}

/// Returns the mutant's number; −1 if none is chosen and the numbers of all reached mutants are to be written to the
/// file ETUDE_MUTANTS_REACHED.
inline int ReadChoice() {
  if (std::getenv("ETUDE_MUTANTS_REACHED") != nullptr) {
    std::atexit(WriteReached);
    return -1;
  }
  const char* number = std::getenv("ETUDE_MUTANT");
  return number == nullptr ? 0 : std::atoi(number);
}

inline int chosen = ReadChoice();

inline bool On(int number) {
  if (chosen < 0) {
    reached[number] = 1;
    return false;
  }
  return chosen == number;
}

/// Called if the mutated expression is meaningless or has another type; leaves a note in the object file.
template <int kNumber>
inline void Impossible() {
  asm volatile(".pushsection .etude,\"\",@progbits\n.ascii \"etude: no mutant %c0;\"\n.popsection" : : "i"(kNumber));
}

template <class Operator, class A>
struct Bound {
  const A& a;
};

// `a < Less<7>{} < b` is `a < b`, or another comparison for mutants 7 and 8. Placed between two operators of the same
// precedence, it gets the original operator's operands.
#define ETUDE_MUTATION_OPERATOR(Name, op, other1, second, other2)                       \
  template <int kNumber>                                                                \
  struct Name {};                                                                       \
  template <class A, int kNumber>                                                       \
  Bound<Name<kNumber>, A> operator op(const A& a, Name<kNumber>) {                      \
    return {a};                                                                         \
  }                                                                                     \
  template <class A, int kNumber, class B>                                              \
  auto operator op(Bound<Name<kNumber>, A> left, const B& b) {                          \
    const A& a = left.a;                                                                \
    constexpr bool kPossible = requires {                                               \
      requires std::is_same_v<decltype(a op b), decltype(a other1 b)>;                  \
      requires std::is_same_v<decltype(a op b), decltype(a other2 b)>;                  \
    };                                                                                  \
    if constexpr (kPossible) {                                                          \
      return On(kNumber) ? (a other1 b) : On(kNumber + second) ? (a other2 b) : (a op b); \
    } else {                                                                            \
      Impossible<kNumber>();                                                            \
      return a op b;                                                                    \
    }                                                                                   \
  }
ETUDE_MUTATION_OPERATOR(Less, <, <=, 1, >=)
ETUDE_MUTATION_OPERATOR(Greater, >, >=, 1, <=)
ETUDE_MUTATION_OPERATOR(LessEqual, <=, <, 1, >)
ETUDE_MUTATION_OPERATOR(GreaterEqual, >=, >, 1, <)
ETUDE_MUTATION_OPERATOR(Equal, ==, !=, 0, !=)
ETUDE_MUTATION_OPERATOR(Unequal, !=, ==, 0, ==)
ETUDE_MUTATION_OPERATOR(Plus, +, -, 0, -)
ETUDE_MUTATION_OPERATOR(Minus, -, +, 0, +)
ETUDE_MUTATION_OPERATOR(Times, *, /, 0, /)
ETUDE_MUTATION_OPERATOR(Over, /, *, 0, *)
ETUDE_MUTATION_OPERATOR(Modulo, %, *, 0, *)
#undef ETUDE_MUTATION_OPERATOR

/// `-Negation<7>{}->*b` is `-b`, or b for the mutant. (->* is a binary operator that binds as tightly as a sign.)
template <int kNumber>
struct Negation {};
template <int kNumber, class B>
auto operator->*(Negation<kNumber>, const B& b) {
  constexpr bool kDecays = requires { requires std::is_same_v<decltype(-b), std::decay_t<decltype(+b)>>; };
  constexpr bool kStays = requires { requires std::is_same_v<decltype(-b), B>; };
  if constexpr (kDecays || kStays) {
    return On(kNumber) ? b : -b;
  } else {
    Impossible<kNumber>();
    return -b;
  }
}

/// Returns b, or −b for the mutant.
template <int kNumber, class B>
B Opposite(const B& b) {
  if constexpr (requires { static_cast<B>(-b); }) {
    if (On(kNumber)) return static_cast<B>(-b);
  } else {
    Impossible<kNumber>();
  }
  return b;
}

/// Returns b, or 1 / b for the mutant.
template <int kNumber, class B>
B Inverse(const B& b) {
  if constexpr (std::is_floating_point_v<B>) {
    if (On(kNumber)) return 1 / b;
  } else {
    Impossible<kNumber>();
  }
  return b;
}

/// Computes `a && b`, or `a || b` for the mutant; computes the second operand only if needed.
template <class B>
bool And(int number, bool a, const B& b) {
  return On(number) ? a || b() : a && b();
}
template <class B>
bool Or(int number, bool a, const B& b) {
  return On(number) ? a && b() : a || b();
}

/// Computes std::min or std::max; for the mutant, the other one.
template <int kNumber>
struct Min {
  template <class A>
  const A& operator()(const A& a, const A& b) const {
    return On(kNumber) ? std::max(a, b) : std::min(a, b);
  }
  template <class A>
  A operator()(std::initializer_list<A> list) const {
    return On(kNumber) ? std::max(list) : std::min(list);
  }
};
template <int kNumber>
struct Max {
  template <class A>
  const A& operator()(const A& a, const A& b) const {
    return On(kNumber) ? std::min(a, b) : std::max(a, b);
  }
  template <class A>
  A operator()(std::initializer_list<A> list) const {
    return On(kNumber) ? std::min(list) : std::max(list);
  }
};

}  // namespace etude_mutation
