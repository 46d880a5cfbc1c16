#include "courant/cli/command_main.hpp"

int main(int argc, char** argv) { return courant::command_main(argc, argv); }
