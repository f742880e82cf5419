// Started by `yamaro view` when a part is clicked: tells the extension which line to show.
const { connect } = require("node:net");
const [socket, file, line, column] = process.argv.slice(2);
const connection = connect(socket, () => {
  connection.end(JSON.stringify({ file, line: Number(line), column: Number(column) }));
});
connection.on("error", () => process.exit(1));
