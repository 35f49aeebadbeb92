// Reads a model with Coin and does nothing with it: the time that any tool based on Coin needs
// before its own work begins.

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/nodes/SoSeparator.h>

int main(int argc, char **argv) {
  if (argc != 2) return 2;
  SoDB::init();
  SoInput input;
  if (!input.openFile(argv[1])) return 1;
  SoSeparator *root = SoDB::readAll(&input);
  return root == nullptr ? 1 : 0;
}
