// VS Code opens a PDDL file; this starts `caveat lsp` and hands the editor to it.

const { commands, window, workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

async function start() {
  const command = workspace.getConfiguration("caveat").get("path", "caveat");
  const server = { command, args: ["lsp"] };
  client = new LanguageClient("caveat", "Caveat", server, {
    documentSelector: [{ language: "pddl" }, { language: "plan" }],
    synchronize: { fileEvents: workspace.createFileSystemWatcher("**/*.{pddl,hddl,plan}") },
  });
  try {
    await client.start();
  } catch (error) {
    window.showErrorMessage(
      `Caveat: \`${command} lsp\` does not start (${error.message}). Set "caveat.path" to the program.`,
    );
  }
}

async function stop() {
  const running = client;
  client = undefined;
  await running?.stop().catch(() => {});
}

exports.activate = async (context) => {
  context.subscriptions.push(
    commands.registerCommand("caveat.restart", async () => {
      await stop();
      await start();
    }),
    workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("caveat.path")) {
        await stop();
        await start();
      }
    }),
  );
  await start();
};

exports.deactivate = stop;
