function: table.func 100
