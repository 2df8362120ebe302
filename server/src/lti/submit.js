// Hands the only form of the page in, once the page is there.
document.forms[0].requestSubmit();
