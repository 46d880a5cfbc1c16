#include "courant/extensions/spice/netlist_cards.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

// Mistakes that these cases have to notice:
//  * a problem of a subcircuit is told for each instance
BOOST_AUTO_TEST_SUITE(netlist_cards)

using namespace courant;
using namespace courant::netlist;

namespace {

Deck deck_of(const std::string& body) {
  LineProblems problems{"the netlist"};
  Deck deck = read_deck("A title\n" + body + "\n", problems);
  problems.require_none();
  return deck;
}

// What is said of a netlist that is wrong.
std::string refusal(const std::string& body) {
  try {
    deck_of(body);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const LineError& error) {
    return std::to_string(error.line) + ": " + error.what;
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(words_and_assignments_of_a_card) {
  const Line line{.number = 7,
                  .words = {"c1", "a", "b", "ic", "=", "2", "c", "=", "1u", "ic", "=", "3"},
                  .written = {"C1", "a", "b", "IC", "=", "2", "C", "=", "1u", "IC", "=", "3"}};
  const Card card = card_of(line);
  BOOST_TEST(card.words.size() == 3u);
  BOOST_TEST(card.assigned.size() == 3u);
  BOOST_TEST(card.value("ic").value() == "3");  // the last counts
  BOOST_TEST(!card.value("l").has_value());
  BOOST_TEST(card.value_of(3, "c") == "1u");
  BOOST_TEST(card.value_of(2, "c") == "b");
  BOOST_TEST(refusal_of([&] { card.word(3, "value"); }) == "7: has no value; expected one");
  BOOST_TEST(refusal_of([&] { card.allow(3, {"c"}); }) == "7: the parameter ic is not supported");
  BOOST_TEST(refusal_of([&] {
               card.allow(2, {"c", "ic"});
             }) == "7: does not end before \"b\"; expected nothing there");
  card.allow(3, {"c", "ic"});
}

BOOST_AUTO_TEST_CASE(assignments_end_a_card) {
  const Line begins{.number = 2, .words = {"=", "1"}, .written = {"=", "1"}};
  BOOST_TEST(refusal_of([&] { card_of(begins); }) == "2: begins with =");
  const Line middle{
      .number = 3, .words = {"r1", "r", "=", "1", "a"}, .written = {"r1", "r", "=", "1", "a"}};
  BOOST_TEST(refusal_of([&] { card_of(middle); }) == "3: expected name = value at the end");
}

BOOST_AUTO_TEST_CASE(cards_go_where_they_belong) {
  const Deck deck = deck_of(
      "r1 a 0 1k\n.param rx=2 ry=3\n.subckt half in out size=1\n.param inner=4\nr2 in out {size}\n"
      ".model dd d is=1e-12\n.ends\nx1 a 0 half\n.model dd d(n=2)\n.ic v(a)=1 v(b)=2\n.tran 1u 1m\n"
      ".options reltol=1e-6\n.control\nrun\nplot v(a)\n.endc");
  BOOST_TEST(deck.title == "A title");
  BOOST_TEST(deck.whole.elements.size() == 2u);
  BOOST_TEST(deck.whole.parameters.size() == 2u);
  BOOST_TEST(deck.whole.parameters[1].value == "3");
  BOOST_TEST(deck.whole.models.at("dd").type == "d");
  BOOST_TEST(deck.whole.models.at("dd").value("n", "1") == "2");
  BOOST_TEST(deck.whole.models.at("dd").value("is", "1e-14") == "1e-14");
  const Part& half = deck.subcircuits.at("half");
  BOOST_TEST(half.nodes.size() == 2u);
  BOOST_TEST(half.header.size() == 1u);
  BOOST_TEST(half.parameters.size() == 1u);
  BOOST_TEST(half.elements.size() == 1u);
  BOOST_TEST(half.models.at("dd").value("is", "") == "1e-12");
  BOOST_TEST(deck.initial.size() == 2u);
  BOOST_TEST(deck.initial[1].node == "b");
  BOOST_TEST_REQUIRE(deck.transient.has_value());
  BOOST_TEST(deck.transient->words.back() == "1m");
}

// What does not change a transient is passed over, each card once; of commands only tran counts, and only where there is no card.
BOOST_AUTO_TEST_CASE(other_analyses_are_passed_over) {
  const Deck deck = deck_of(
      ".ac dec 10 1 1k\n.op\n.print tran v(a)\n.print ac v(a)\n.temp 50\n.global vdd vss\n"
      ".control\nalter r1=2\ntran 1n 5n\n.endc");
  BOOST_TEST(deck.passed == (std::vector<std::string>{".ac", ".op", ".print", ".temp", ".control"}),
             boost::test_tools::per_element());
  BOOST_TEST(deck.globals.contains("vdd"));
  BOOST_TEST(deck.temperature == "50");
  BOOST_TEST(deck_of(".options reltol=1e-3 temp=85").temperature == "85");
  BOOST_TEST(deck_of(".temp 27").temperature.empty());
  BOOST_TEST_REQUIRE(deck.transient.has_value());
  BOOST_TEST(deck.transient->words.back() == "5n");
  BOOST_TEST(deck_of(".control\ntran 1n 5n\n.endc\n.tran 1n 7n").transient->words.back() == "7n");
}

// With = or without, and names that have no value.
BOOST_AUTO_TEST_CASE(values_of_models_may_stand_without_signs) {
  const Deck deck = deck_of(".model q npn bf=80 va 50 tc=1m,2u off\n+ is 1e-15");
  const DeviceModel& model = deck.whole.models.at("q");
  BOOST_TEST(model.value("bf", "") == "80");
  BOOST_TEST(model.value("va", "") == "50");
  BOOST_TEST(model.value("tc", "") == "1m,2u");
  BOOST_TEST(model.value("off", "") == "1");
  BOOST_TEST(model.value("is", "") == "1e-15");
  BOOST_TEST(refusal(".model q npn bf=") == "line 2: expected name = value at the end");
}

BOOST_AUTO_TEST_CASE(cards_out_of_place_are_refused) {
  BOOST_TEST(refusal(".ends") == "line 2: ends no .subckt; expected one before");
  BOOST_TEST(refusal(".subckt a b").starts_with("line 2: this .subckt has no .ends"));
  BOOST_TEST(refusal(".control\nrun").starts_with("line 2: .control has no .endc"));
  BOOST_TEST(refusal(".param r") == "line 2: expected .param name=value …");
  BOOST_TEST(refusal(".model q").starts_with("line 2: has no type"));
  BOOST_TEST(refusal(".laplace") == "line 2: .laplace is not supported");
  BOOST_TEST(refusal(".subckt a b\n.ends\n.subckt a b\n.ends") ==
             "line 4: the subcircuit a is that of line 2 again");
}

BOOST_AUTO_TEST_CASE(problems_are_told_once_in_the_order_of_lines) {
  LineProblems problems{"the netlist"};
  BOOST_TEST(problems.empty());
  problems.add(0, "has no end");
  problems.add(9, "is late");
  for (int instance = 0; instance < 2; ++instance)
    problems.guard([] { throw LineError{3, "is wrong"}; });
  BOOST_TEST(!problems.empty());
  try {
    problems.require_none();
    BOOST_TEST(false);
  } catch (const ExperimentError& error) {
    BOOST_TEST(error.problems().size() == 3u);
    BOOST_TEST(error.problems()[0].where == "line 3");
    BOOST_TEST(error.problems()[1].where == "line 9");
    BOOST_TEST(error.problems()[2].where == "the netlist");
  }
  BOOST_TEST(in_words({"rs"}) == "rs");
  BOOST_TEST(in_words({"rs", "cjo", "tt"}) == "rs, cjo and tt");
}

BOOST_AUTO_TEST_SUITE_END()
