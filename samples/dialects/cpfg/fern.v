angle increment: 55
function: grow.func 100
function: open.func 100
initial color: 6
