#include "courant/cli/synopsis.hpp"

#include <CLI/CLI.hpp>
#include <boost/test/unit_test.hpp>

#include "answer.hpp"
#include "courant/cli/completion_script.hpp"
#include "courant/cli/manual_page.hpp"

namespace courant::cli {
// Mistakes that these cases have to notice:
//  * what is hidden in --help has a manual page
//  * a text that begins with a dot is obeyed by roff (cli/manual_page.cpp)
BOOST_AUTO_TEST_SUITE(synopsis_test)

namespace {

using test::Answer;
using test::courant_command;

void check_contains(const std::string& text, const std::string& part) {
  BOOST_TEST(text.find(part) != std::string::npos, part << " is not in\n" << text);
}

// A command with everything that an argument can be.
struct Brew {
  CLI::App app{"Make coffee.", "brew"};
  std::string bean, folder;
  std::vector<std::string> notes;
  bool strong = false;

  Brew() {
    CLI::App* pot = app.add_subcommand("pot", "Brew a pot, for [all] who \\drink: it's good");
    pot->add_option("FILE", bean, "the beans")->required();
    pot->add_option("-o,--output", folder, "where it goes")->type_name("DIR");
    pot->add_option("--roast", bean, ".light is not 'strong' ~ ^")
        ->type_name("light|dark")
        ->required();
    CLI::Option* note = pot->add_option("--note", notes, "a note")
                            ->type_name("TEXT")
                            ->expected(1)
                            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    pot->add_flag("--strong", strong, "twice the beans")->excludes(note)->needs("--roast");
    app.add_subcommand("secret", "Not shown")->group("");
    CLI::App* help = app.add_subcommand("help", "Say how");
    help->add_option("COMMAND", bean, "which");
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(says_what_a_command_takes) {
  const Brew brew;
  const Synopsis all = synopsis(brew.app);
  BOOST_TEST(all.main.name == "brew");
  BOOST_TEST_REQUIRE(all.commands.size() == 2u);  // the hidden one is not there
  const CommandSynopsis& pot = all.commands[0];
  BOOST_TEST_REQUIRE(pot.positionals.size() == 1u);
  BOOST_TEST(pot.positionals[0].takes_file());
  BOOST_TEST(pot.positionals[0].is_required);
  BOOST_TEST_REQUIRE(pot.options.size() == 5u);  // with --help
  const ArgumentSynopsis &output = pot.options[1], &roast = pot.options[2], &note = pot.options[3],
                         &strong = pot.options[4];
  BOOST_TEST(output.names == (std::vector<std::string>{"-o", "--output"}),
             boost::test_tools::per_element());
  BOOST_TEST(output.takes_folder());
  BOOST_TEST(!output.is_repeated);
  BOOST_TEST(roast.words == (std::vector<std::string>{"light", "dark"}),
             boost::test_tools::per_element());
  BOOST_TEST(roast.is_required);
  BOOST_TEST(note.is_repeated);
  BOOST_TEST(note.value == "TEXT");
  BOOST_TEST(strong.value == "");
  BOOST_TEST(strong.needs == std::vector<std::string>{"--roast"}, boost::test_tools::per_element());
  BOOST_TEST(strong.excludes == std::vector<std::string>{"--note"},
             boost::test_tools::per_element());
  BOOST_TEST(all.commands[1].positionals[0].words == (std::vector<std::string>{"pot", "help"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_manual_page_prints_what_stands_there) {
  const Brew brew;
  const Synopsis all = synopsis(brew.app);
  const std::string page = manual_page(all, all.commands[0]);
  check_contains(page, ".TH BREW\\-POT 1 ");
  check_contains(page, "brew\\-pot \\- Brew a pot, for [all] who \\edrink: it\\(aqs good\n");
  check_contains(page, "\\fBbrew pot\\fR [\\fIOPTION\\fR...] \\fIFILE\\fR\n");
  check_contains(page, "\n\\&.light is not \\(aqstrong\\(aq \\(ti \\(ha.\nRequired.\n");
  check_contains(page, "\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIDIR\\fR\n");
  check_contains(page, "Only with \\fB\\-\\-roast\\fR.\nNot with \\fB\\-\\-note\\fR.\n");
  for (const char* part : {"\\fBbrew\\-pot\\fR(1)\n", "\\fBbrew\\-help\\fR(1)\n", "EXIT STATUS"})
    check_contains(manual_page(all), part);
}

BOOST_AUTO_TEST_CASE(completion_knows_what_an_argument_is) {
  const Brew brew;
  const Synopsis all = synopsis(brew.app);
  const std::string bash = bash_completion(all), zsh = zsh_completion(all);
  for (const char* part :
       {"-o | --output) _courant_offer -d; return ;;", "_courant_offer -W 'pot help'",
        "--roast) _courant_offer -W 'light dark'; return ;;", "--note) :; return ;;",
        "*) _courant_offer -f ;;"})
    check_contains(bash, part);
  for (const char* part :
       {"'pot:Brew a pot, for [all] who \\\\drink\\: it'\\''s good'",
        "'(-o --output)-o[where it goes]:DIR:_files -/'", "'(--strong)*--note[a note]:TEXT: '",
        "'1:FILE:_files'", "'(--note --strong)--strong[twice the beans]'",
        ":--roast:(light dark)'"})
    check_contains(zsh, part);
}

// Every command that --help lists has a page, and every page the options that its --help lists.
BOOST_AUTO_TEST_CASE(the_command_prints_its_pages) {
  const std::string main = courant_command({"man"}).out;
  for (const char* name : {"run", "constraints", "tour", "man", "completion"}) {
    check_contains(main, std::string("\\fBcourant\\-") + name + "\\fR(1)\n");
    BOOST_TEST(courant_command({"man", name}).status == 0);
  }
  check_contains(courant_command({"man", "run"}).out, "\\fB\\-\\-resume\\fR\n");
  const Answer wrong = courant_command({"man", "rum"});
  BOOST_TEST(wrong.status == 2);
  BOOST_TEST(wrong.err == "courant: man: there is no command \"rum\" (did you mean \"run\"?)\n");
  check_contains(courant_command({"completion", "bash"}).out, "auto native interpreter");
  check_contains(courant_command({"completion", "zsh"}).out, "'run:Run an experiment");
  BOOST_TEST(courant_command({"completion", "fish"}).status == 2);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::cli
