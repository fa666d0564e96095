angle factor: 12
function: rise.func 100
function set: more.fset
